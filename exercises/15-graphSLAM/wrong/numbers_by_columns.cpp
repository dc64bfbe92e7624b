// caught by: camera-linear, camera-any
// mistake: takes the twelve numbers column by column.

// <solution projectionFromPoints>
const Eigen::MatrixXd T = conditioning(points), U = conditioning(pixels);
const Eigen::MatrixXd X = T * homogeneous(points), x = U * homogeneous(pixels);
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * X.cols(), 12);
for (Eigen::Index i = 0; i < X.cols(); ++i)
  for (int k = 0; k < 2; ++k) {
    A.block<1, 4>(2 * i + k, 4 * k) = X.col(i).transpose();
    A.block<1, 4>(2 * i + k, 8) = -x(k, i) * X.col(i).transpose();
  }
const Eigen::VectorXd p = svd(A).V.col(11);
Eigen::MatrixXd P(3, 4);
for (int k = 0; k < 12; ++k) P(k % 3, k / 3) = p[k];
return inverse(U) * P * T;
// </solution>
