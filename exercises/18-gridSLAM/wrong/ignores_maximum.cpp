// caught by: update, more-updates
// mistake: rays that hit nothing are left out.

// <solution observed>
const Eigen::Vector2d p(pose[0], pose[1]);
Eigen::MatrixXd change = Eigen::MatrixXd::Zero(map.values.rows(), map.values.cols());
for (Eigen::Index ray = 0; ray < scan.angles.size(); ++ray) {
  const bool isHit = scan.ranges[ray] < scan.maxRange;
  if (!isHit) continue;
  const double direction = pose[2] + scan.angles[ray];
  const double range = std::min(scan.ranges[ray], scan.maxRange);
  const auto cells =
      cellsAlong(map, p, p + range * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int x = cells[i][0], y = cells[i][1];
    if (x < 0 || y < 0 || x >= change.rows() || y >= change.cols()) continue;
    if (isHit && i + 1 == cells.size())
      change(x, y) = evidence.hit;
    else if (change(x, y) != evidence.hit)
      change(x, y) = evidence.miss;
  }
}
after.values = (map.values + change).cwiseMax(-evidence.bound).cwiseMin(evidence.bound);
// </solution>
