// caught by: kf-covariance
// mistake: stops correcting once everything is known within three millimetres.

// <solution corrected>
if (belief.covariance.diagonal().maxCoeff() < 9e-6) return belief;
const Eigen::Index n = belief.mean.size();
const Eigen::MatrixXd CS = C * belief.covariance, innovation = CS * C.transpose() + W;
const Eigen::MatrixXd K = solveMatrix(innovation, CS).transpose();
const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - K * C, KW = K * W;
const Eigen::MatrixXd LS = left * belief.covariance;
const Eigen::MatrixXd S = LS * left.transpose() + KW * K.transpose();
return {belief.mean + K * gap, symmetric(S)};
// </solution>
