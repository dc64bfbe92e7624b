// caught by: improves, unseen-improve
// shown by: improves
// mistake: stops after one improvement.

// <solution iteratePolicies>
const Eigen::Index n = process.R.rows();
std::vector<std::vector<int>> policies(2, std::vector<int>(static_cast<std::size_t>(n), 0));
Eigen::MatrixXd first = Eigen::MatrixXd::Zero(n, process.R.cols());
first.col(0).setOnes();
const Eigen::MatrixXd Q = worthOfActions(process, valuesOf(process, first));
for (Eigen::Index s = 0; s < n; ++s) Q.row(s).maxCoeff(&policies[1][static_cast<std::size_t>(s)]);
return policies;
// </solution>
