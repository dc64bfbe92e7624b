// caught by: camera-refined, camera-any
// mistake: subtracts the wrong way round.

// <solution reprojectionErrors>
for (Eigen::Index i = 0; i < points.cols(); ++i) {
  const Eigen::Vector3d seen = P.leftCols<3>() * points.col(i) + P.col(3);
  errors.col(i) = pixels.col(i) - seen.head<2>() / seen[2];
}
// </solution>
