// caught by: slam-start
// mistake: a new landmark is not correlated with the car.

// <solution withLandmark>
const Eigen::Vector3d x = joint.mean.head(3);
const Eigen::Vector2d l = placed(car, x, y);
const Eigen::MatrixXd byView = inverse(viewByLandmark(car, x, l));
const Eigen::MatrixXd C = -viewByState(car, x, l), byState = byView * C, rows = joint.covariance.topRows(3);
const Eigen::MatrixXd cross = byState * rows, own = cross.leftCols(3), noise = byView * viewNoise(car);
const Eigen::MatrixXd S = own * byState.transpose() + noise * byView.transpose();
larger.mean.tail(2) = l;
larger.covariance.bottomRightCorner(2, 2) = symmetric(S);
// </solution>
