// caught by: gradient
// mistake: leaves out the variance of the action.

// <solution reinforce>
Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  for (Eigen::Index t = 0; t < Q.size(); ++t)
    sum +=
        std::pow(discount, t) * Q[t] * trial.features.col(t).dot(trial.noise.col(t)) * trial.features.col(t);
}
return sum / static_cast<double>(trials.size());
// </solution>
