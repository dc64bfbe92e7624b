// caught by: car-follows
// mistake: takes measured poses for exact ones.

// <solution canFollow>
for (std::size_t i = 1; i < path.size(); ++i) {
  const Eigen::Vector3d &a = path[i - 1], &b = path[i];
  const double turn = std::remainder(b[2] - a[2], 2 * std::numbers::pi), middle = a[2] + turn / 2;
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  // The constraint of 4:49 holds for the chord of an arc with the heading in the middle of it.
  if (std::abs(dx * std::sin(middle) - dy * std::cos(middle)) > 1e-9) return false;
  const double chord = dx * std::cos(middle) + dy * std::sin(middle);
  if (std::abs(chord) < 1e-9) {
    if (std::abs(turn) > 1e-9) return false;
    continue;
  }
  const double curvature = 2 * std::sin(turn / 2) / chord, steering = std::atan(car.wheelbase * curvature);
  if (steering < car.minSteering || steering > car.maxSteering) return false;
}
return true;
// </solution>
