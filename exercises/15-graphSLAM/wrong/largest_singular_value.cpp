// caught by: camera-linear, camera-any
// mistake: takes the direction in which A p is longest.

// <solution projectionFromPoints>
const Eigen::MatrixXd T = conditioning(points), U = conditioning(pixels);
const Eigen::MatrixXd X = T * homogeneous(points), x = U * homogeneous(pixels);
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * X.cols(), 12);
for (Eigen::Index i = 0; i < X.cols(); ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
  }
const Eigen::MatrixXd P = fromNumbers(svd(A).V.col(0));
return inverse(U) * P * T;
// </solution>
