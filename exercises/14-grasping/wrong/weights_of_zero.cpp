// caught by: verdicts, grasps, border
// mistake: asks whether zero is in the hull, with weights that may be zero.

// <solution judged>
const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
Eigen::MatrixXd A(d + 1, n);
A << wrenches, Eigen::RowVectorXd::Ones(n);
Eigen::VectorXd b = Eigen::VectorXd::Zero(d + 1);
b[d] = 1;
const LinearSolution inside = minimizeLinear(A, b, Eigen::VectorXd::Zero(n));
if (inside.status == LinearStatus::kOptimal) return {true, inside.x};
return {false, -inside.y.head(d).normalized()};
// </solution>
