// caught by: camera-linear, camera-any
// mistake: uses the first six points only.

// <solution projectionFromPoints>
const Eigen::MatrixXd T = conditioning(points), U = conditioning(pixels);
const Eigen::MatrixXd X = T * homogeneous(points), x = U * homogeneous(pixels);
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(12, 12);
for (Eigen::Index i = 0; i < 6; ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
  }
const Eigen::MatrixXd P = fromNumbers(svd(A).V.col(11));
return inverse(U) * P * T;
// </solution>
