// caught by: improves, unseen-improve
// mistake: lists the policy that no longer changes once more.

// <solution iteratePolicies>
const auto n = static_cast<std::size_t>(process.R.rows());
std::vector<std::vector<int>> policies{std::vector<int>(n, 0)};
for (;;) {
  std::vector<int> actions = policies.back();
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
  for (std::size_t s = 0; s < n; ++s) policy(static_cast<Eigen::Index>(s), actions[s]) = 1;
  const Eigen::VectorXd V = valuesOf(process, policy);
  const Eigen::MatrixXd Q = worthOfActions(process, V);
  for (std::size_t s = 0; s < n; ++s) {
    int best = 0;
    const auto row = static_cast<Eigen::Index>(s);
    if (Q.row(row).maxCoeff(&best) > Q(row, actions[s]) + 1e-11 * V.cwiseAbs().maxCoeff()) actions[s] = best;
  }
  policies.push_back(actions);
  if (actions == policies[policies.size() - 2]) return policies;
}
// </solution>
