// caught by: car-follows
// shown by: car-follows
// mistake: takes the limits to be symmetric.

// <solution canFollow>
for (std::size_t k = 1; k < path.size(); ++k) {
  const Eigen::Vector3d &a = path[k - 1], &b = path[k];
  const double turn = std::remainder(b[2] - a[2], 2 * std::numbers::pi), middle = a[2] + turn / 2;
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  // The constraint of 4:49 holds for the chord of an arc with the heading in the middle of it.
  if (std::abs(dx * std::sin(middle) - dy * std::cos(middle)) > 1e-4) return false;
  const double chord = dx * std::cos(middle) + dy * std::sin(middle);
  if (std::abs(chord) < 1e-4) {
    if (std::abs(turn) > 1e-4) return false;
    continue;
  }
  const double curvature = 2 * std::sin(turn / 2) / chord, steering = std::atan(car.wheelbase * curvature);
  if (std::abs(steering) > car.maxSteering + 0.01) return false;
}
return true;
// </solution>
