// caught by: kf-step, kf-any
// shown by: kf-step
// mistake: x + B(x) u for the next state, as on the sheet: the car turns twice as much.

// <solution predicted>
const Eigen::Vector3d x = belief.mean;
const Eigen::MatrixXd A = stepByState(car, x, u), AS = A * belief.covariance;
const Eigen::MatrixXd S = AS * A.transpose() + stepNoise(car);
return {x + stepByControl(car, x, u) * u, symmetric(S)};
// </solution>
