// caught by: bearings, finds-heading
// shown by: bearings
// mistake: the direction of a landmark on the map, without the heading of the car.

// <solution viewFrom>
const double c = std::cos(x[2]), s = std::sin(x[2]);
for (Eigen::Index i = 0; i < world.landmarks.cols(); ++i) {
  const double dx = world.landmarks(0, i) - x[0], dy = world.landmarks(1, i) - x[1];
  y[2 * i] = world.rangeBearing ? std::hypot(dx, dy) : c * dx + s * dy;
  y[2 * i + 1] = world.rangeBearing ? std::atan2(dy, dx) : c * dy - s * dx;
}
// </solution>
