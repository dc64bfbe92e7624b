// caught by: car-follows
// mistake: each piece overwrites the verdict on the one before.

// <solution canFollow>
bool follows = true;
for (std::size_t i = 1; i < path.size(); ++i) {
  const Eigen::Vector3d &a = path[i - 1], &b = path[i];
  const double turn = std::remainder(b[2] - a[2], 2 * std::numbers::pi), middle = a[2] + turn / 2;
  const double dx = b[0] - a[0], dy = b[1] - a[1];
  const double chord = dx * std::cos(middle) + dy * std::sin(middle);
  const double steering = std::atan(car.wheelbase * 2 * std::sin(turn / 2) / chord);
  follows = std::abs(dx * std::sin(middle) - dy * std::cos(middle)) < 1e-4 &&
            steering > car.minSteering - 0.01 && steering < car.maxSteering + 0.01;
}
return follows;
// </solution>
