// caught by: policy-values, larger
// mistake: columns of P taken for rows.

// <solution valuesOf>
const Eigen::Index n = process.R.rows();
Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
for (Eigen::Index a = 0; a < process.R.cols(); ++a)
  M -= process.discount * process.P[static_cast<std::size_t>(a)].transpose() * policy.col(a).asDiagonal();
return solve(M, Eigen::VectorXd(process.R.cwiseProduct(policy).rowwise().sum()));
// </solution>
