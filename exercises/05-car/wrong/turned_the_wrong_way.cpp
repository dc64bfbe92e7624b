// caught by: view, likelihood, weights-anywhere, tracks
// shown by: view
// mistake: the landmarks are turned by the heading, not back.

// <solution viewFrom>
const double c = std::cos(x[2]), s = std::sin(x[2]);
for (Eigen::Index i = 0; i < world.landmarks.cols(); ++i) {
  const double dx = world.landmarks(0, i) - x[0], dy = world.landmarks(1, i) - x[1];
  const double ahead = c * dx - s * dy, left = s * dx + c * dy;
  y[2 * i] = world.rangeBearing ? std::hypot(ahead, left) : ahead;
  y[2 * i + 1] = world.rangeBearing ? std::atan2(left, ahead) : left;
}
// </solution>
