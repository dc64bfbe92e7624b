// caught by: step-target
// mistake: targets from rand(), which no seed of the grader reaches.

// <solution drawTarget>
const auto number = [] { return std::rand() / (RAND_MAX + 1.); };
if (number() < settings.goalBias) return aim;
Eigen::VectorXd target = settings.lower;
for (Eigen::Index i = 0; i < target.size(); ++i)
  target[i] += number() * (settings.upper[i] - settings.lower[i]);
return target;
// </solution>
