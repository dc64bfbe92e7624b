// caught by: policy-values, larger
// shown by: policy-values
// mistake: takes all actions to be equally likely.

// <solution valuesOf>
const Eigen::Index n = process.R.rows();
Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
for (const Eigen::MatrixXd& P : process.P) M -= process.discount / static_cast<double>(policy.cols()) * P;
return solve(M, Eigen::VectorXd(process.R.rowwise().mean()));
// </solution>
