// caught by: power, more-power
// mistake: for two features only.

// <solution power>
const Eigen::Index k = policy.beta.size();
Eigen::Matrix2d weights = Eigen::MatrixXd::Zero(k, k);
Eigen::Vector2d moves = Eigen::VectorXd::Zero(k);
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  for (Eigen::Index t = 0; t < Q.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const Eigen::MatrixXd W = phi * phi.transpose() / (policy.L.transpose() * phi).squaredNorm();
    weights += W * Q[t];
    moves += W * trial.noise.col(t) * Q[t];
  }
}
return policy.beta + solve(weights, moves);
// </solution>
