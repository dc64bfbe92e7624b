// caught by: improves
// mistake: switches to another action that is only as good.

// <solution iteratePolicies>
const auto n = static_cast<std::size_t>(process.R.rows());
std::vector<std::vector<int>> policies{std::vector<int>(n, 0)};
for (;;) {
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
  for (std::size_t s = 0; s < n; ++s) policy(static_cast<Eigen::Index>(s), policies.back()[s]) = 1;
  const Eigen::MatrixXd Q = worthOfActions(process, valuesOf(process, policy));
  std::vector<int> actions(n);
  for (std::size_t s = 0; s < n; ++s) Q.row(static_cast<Eigen::Index>(s)).maxCoeff(&actions[s]);
  if (actions == policies.back()) return policies;
  policies.push_back(actions);
}
// </solution>
