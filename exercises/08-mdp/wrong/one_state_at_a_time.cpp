// caught by: improves, unseen-improve
// shown by: improves
// mistake: improves the action of one state in each iteration.

// <solution iteratePolicies>
const auto n = static_cast<std::size_t>(process.R.rows());
std::vector<std::vector<int>> policies{std::vector<int>(n, 0)};
for (bool isBetter = true; isBetter;) {
  isBetter = false;
  std::vector<int> actions = policies.back();
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(process.R.rows(), process.R.cols());
  for (std::size_t s = 0; s < n; ++s) policy(static_cast<Eigen::Index>(s), actions[s]) = 1;
  const Eigen::VectorXd V = valuesOf(process, policy);
  const Eigen::MatrixXd Q = worthOfActions(process, V);
  for (std::size_t s = 0; s < n && !isBetter; ++s) {
    int best = 0;
    const auto row = static_cast<Eigen::Index>(s);
    if (Q.row(row).maxCoeff(&best) <= Q(row, actions[s]) + 1e-11 * V.cwiseAbs().maxCoeff()) continue;
    actions[s] = best;
    isBetter = true;
  }
  if (isBetter) policies.push_back(actions);
}
return policies;
// </solution>
