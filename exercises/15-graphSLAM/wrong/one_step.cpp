// caught by: camera-refined, camera-any
// shown by: camera-refined
// mistake: takes one step only.

// <solution refined>
Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2 * points.cols(), 12);
for (int k = 0; k < 1; ++k) {
  best /= best.norm();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector4d X;
    X << points.col(i), 1;
    const Eigen::Vector3d seen = best * X;
    for (int row = 0; row < 2; ++row) {
      J.block<1, 4>(2 * i + row, 4 * row) = X.transpose() / seen[2];
      J.block<1, 4>(2 * i + row, 8) = -seen[row] / (seen[2] * seen[2]) * X.transpose();
    }
  }
  const Eigen::VectorXd e = reprojectionErrors(best, points, pixels).reshaped();
  const Eigen::VectorXd step = leastSquares(J, -e);
  best += fromNumbers(step);
  if (step.norm() < 1e-12) break;
}
// </solution>
