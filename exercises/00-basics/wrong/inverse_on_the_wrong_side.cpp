// caught by: square-equations, any-size
// mistake: Divides from the left, though A stands to the right of X.

// <solution equationA>
const Eigen::MatrixXd Id = Eigen::MatrixXd::Identity(A.rows(), A.cols());
return inverse(A) * (Id - A.transpose());
// </solution>
