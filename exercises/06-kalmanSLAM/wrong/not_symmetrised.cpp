// caught by: kf-correct, kf-covariance, slam-correct
// mistake: leaves the covariance slightly asymmetric, because of rounding.

// <solution corrected>
const Eigen::Index n = belief.mean.size();
const Eigen::MatrixXd CS = C * belief.covariance, innovation = CS * C.transpose() + W;
const Eigen::MatrixXd K = solveMatrix(innovation, CS).transpose();
const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - K * C;
return {belief.mean + K * gap, left* belief.covariance};
// </solution>
