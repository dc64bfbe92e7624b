// caught by: kf-step, kf-track
// shown by: kf-track
// mistake: predicts without the noise of the step.

// <solution predicted>
const Eigen::Vector3d x = belief.mean;
const Eigen::MatrixXd A = stepByState(car, x, u), AS = A * belief.covariance;
const Eigen::MatrixXd S = AS * A.transpose();
return {stepped(car, x, u), symmetric(S)};
// </solution>
