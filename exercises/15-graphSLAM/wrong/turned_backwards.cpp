// caught by: scan-motion, scan-align
// shown by: scan-motion
// mistake: returns the rotation of the opposite direction.

// <solution bestMotion>
Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = a;  // the means
for (std::size_t k = 0; k < from.size(); ++k) {
  a += from[k];
  b += to[k];
}
a /= static_cast<double>(from.size());
b /= static_cast<double>(from.size());
double along = 0, across = 0;
for (std::size_t k = 0; k < from.size(); ++k) {
  const Eigen::Vector2d p = from[k] - a, q = to[k] - b;
  along += p.x() * q.x() + p.y() * q.y();
  across += p.x() * q.y() - p.y() * q.x();
}
const double turn = std::atan2(-across, along), c = std::cos(turn), s = std::sin(turn);
return {b.x() - c * a.x() + s * a.y(), b.y() - s* a.x() - c* a.y(), turn};
// </solution>
