// caught by: gradient
// shown by: gradient
// mistake: squares L phi instead of L^T phi.

// <solution reinforce>
Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  for (Eigen::Index t = 0; t < Q.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L * phi).squaredNorm();
    sum += std::pow(discount, t) * Q[t] * phi.dot(trial.noise.col(t)) / variance * phi;
  }
}
return sum / static_cast<double>(trials.size());
// </solution>
