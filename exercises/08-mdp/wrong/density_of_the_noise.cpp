// caught by: gradient
// shown by: gradient
// mistake: differentiates the density of the noise instead of that of the action.

// <solution reinforce>
Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
const Eigen::MatrixXd Sigma = policy.L * policy.L.transpose();
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  for (Eigen::Index t = 0; t < Q.size(); ++t)
    sum += std::pow(discount, t) * Q[t] * solve(Sigma, Eigen::VectorXd(trial.noise.col(t)));
}
return sum / static_cast<double>(trials.size());
// </solution>
