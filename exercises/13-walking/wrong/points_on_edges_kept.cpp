// caught by: corners
// shown by: corners
// mistake: counts all points in a row as corners, even those between two others.

// <solution supportCorners>
std::vector<Eigen::Vector2d> points;
for (Eigen::Index i = 0; i < contacts.cols(); ++i) points.emplace_back(contacts.col(i));
std::sort(points.begin(), points.end(), [](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
  return p.x() != q.x() ? p.x() < q.x() : p.y() < q.y();
});
points.erase(std::unique(points.begin(), points.end()), points.end());
std::vector<Eigen::Vector2d> corners;
for (int pass = 0; pass < 2 && points.size() > 1; ++pass) {
  const std::size_t first = corners.size();
  for (const Eigen::Vector2d& p : points) {
    while (corners.size() >= first + 2) {
      const Eigen::Vector2d along = corners.back() - corners[corners.size() - 2], on = p - corners.back();
      if (along.x() * on.y() - along.y() * on.x() >= 0) break;
      corners.pop_back();
    }
    corners.push_back(p);
  }
  corners.pop_back();
  std::reverse(points.begin(), points.end());
}
if (points.size() == 1) corners = points;
Eigen::MatrixXd result(2, corners.size());
for (std::size_t i = 0; i < corners.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = corners[i];
return result;
// </solution>
