// caught by: car-follows
// shown by: car-follows
// mistake: does not test the limits of the steering angle.

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
}
return true;
// </solution>
