// caught by: returns
// shown by: returns
// mistake: counts only what follows after the step.

// <solution returnsToGo>
Eigen::VectorXd returns = Eigen::VectorXd::Zero(rewards.size());
for (Eigen::Index t = rewards.size() - 2; t >= 0; --t)
  returns[t] = discount * (rewards[t + 1] + returns[t + 1]);
return returns;
// </solution>
