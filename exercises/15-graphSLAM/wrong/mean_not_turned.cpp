// caught by: scan-motion
// mistake: leaves the mean of the first points where it is.

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
const double turn = std::atan2(across, along);
return {b.x() - a.x(), b.y() - a.y(), turn};
// </solution>
