// caught by: verdicts, grasps, border
// mistake: takes wrenches that span the space for closed, as if they could pull.

// <solution judged>
const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(d, n + d);
padded.leftCols(n) = wrenches;
const SingularValues values = svd(padded);
if (values.s[d - 1] < 1e-9 * values.s[0]) return {false, values.U.col(d - 1)};
return {true, Eigen::VectorXd::Constant(n, 1. / static_cast<double>(n))};
// </solution>
