// caught by: names-found
// mistake: Two sightings may get the same landmark.

// <solution assigned>
for (std::size_t k = 0; k < ys.size(); ++k) {
  double nearest = 50;
  for (int i = 0; 3 + 2 * i < joint.mean.size(); ++i) {
    const ExpectedView expected = expectedView(car, joint, i);
    const Eigen::MatrixXd V = expected.C * joint.covariance * expected.C.transpose() + viewNoise(car);
    const Eigen::Vector2d gap = viewGap(car, ys[k], expected.y);
    const double distance = gap.dot(solve(V, gap));
    if (distance < 25 && distance < nearest) names[k] = i;
    nearest = std::min(nearest, distance);
  }
  if (nearest >= 50) names[k] = kNewLandmark;
}
// </solution>
