// caught by: border, stands-any
// mistake: measures the distance from the infinite lines on which the edges lie.

// <solution borderDistance>
const Eigen::Index k = corners.cols();
double least = INFINITY;
for (Eigen::Index i = 0; i < k; ++i) {
  const Eigen::Vector2d edge = corners.col((i + 1) % k) - corners.col(i), to = point - corners.col(i);
  least = std::min(least, (edge.x() * to.y() - edge.y() * to.x()) / edge.norm());
}
return least;
// </solution>
