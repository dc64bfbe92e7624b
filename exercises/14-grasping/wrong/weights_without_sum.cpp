// caught by: reach, any-reach
// shown by: reach
// mistake: each weight at most one, instead of one for all together.

// <solution reachAlong>
const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(d + n, 2 * n + 1);
A.topLeftCorner(d, n) = wrenches;
A.topRightCorner(d, 1) = -direction;
A.bottomLeftCorner(n, n).setIdentity();
A.block(d, n, n, n).setIdentity();
Eigen::VectorXd b = Eigen::VectorXd::Ones(d + n), cost = Eigen::VectorXd::Zero(2 * n + 1);
b.head(d).setZero();
cost[2 * n] = -1;
return -minimizeLinear(A, b, cost).value;
// </solution>
