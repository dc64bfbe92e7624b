// caught by: camera-linear, camera-any
// shown by: camera-linear
// mistake: returns the P of the scaled points and pixels.

// <solution projectionFromPoints>
const Eigen::MatrixXd T = conditioning(points), U = conditioning(pixels);
const Eigen::MatrixXd X = T * homogeneous(points), x = U * homogeneous(pixels);
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * X.cols(), 12);
for (Eigen::Index i = 0; i < X.cols(); ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
  }
return fromNumbers(svd(A).V.col(11));
// </solution>
