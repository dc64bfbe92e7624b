// caught by: natural, linear-returns
// mistake: adds up F over the trials instead of averaging it.

// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const Eigen::VectorXd slope = phi.dot(trial.noise.col(t)) / variance * phi;
    F += std::pow(discount, t) * slope * slope.transpose();
  }
return solve(F, reinforce(policy, trials, discount));
// </solution>
