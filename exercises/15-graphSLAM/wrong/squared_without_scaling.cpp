// caught by: camera-any
// mistake: squares the equations of points far away without scaling them.

// <solution projectionFromPoints>
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
const Eigen::MatrixXd X = homogeneous(points);
for (Eigen::Index i = 0; i < X.cols(); ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -pixels(k, i) * X.col(i).transpose();
  }
return fromNumbers(svd(A.transpose() * A).V.col(11));
// </solution>
