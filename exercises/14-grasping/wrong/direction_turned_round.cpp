// caught by: verdicts, grasps
// mistake: the direction of an open grasp has the wrong sign.

// <solution judged>
const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(d, n + d);
padded.leftCols(n) = wrenches;
const SingularValues values = svd(padded);
if (values.s[d - 1] < 1e-9 * values.s[0]) return {false, values.U.col(d - 1)};
const LinearSolution rest = minimizeLinear(wrenches, -wrenches.rowwise().sum(), Eigen::VectorXd::Ones(n));
if (rest.status != LinearStatus::kOptimal) return {false, rest.y.normalized()};
const Eigen::VectorXd weights = rest.x.array() + 1;
return {true, weights / weights.sum()};
// </solution>
