// caught by: scan-align
// mistake: looks for partners once, and keeps them.

// <solution aligned>
for (int iteration = 0; iteration < 1; ++iteration) {
  // Partners far away help at first; later they only pull at what is hidden from the other scan.
  const double reach = std::max(0.3, 0.6 * std::pow(0.9, iteration));
  const std::vector<int> numbers = partners(reference, moving, result.motion, reach);
  Points from, to;
  for (std::size_t k = 0; k < moving.size(); ++k)
    if (numbers[k] >= 0) {
      from.push_back(moving[k]);
      to.push_back(reference[static_cast<std::size_t>(numbers[k])]);
    }
  if (from.size() < 3) break;
  result.motion = bestMotion(from, to);
  double squares = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Eigen::Vector3d at = seenFrom(seenFrom(result.motion, Eigen::Vector3d::Zero()),
                                        Eigen::Vector3d(from[k].x(), from[k].y(), 0));
    squares += (Eigen::Vector2d(at[0], at[1]) - to[k]).squaredNorm();
  }
  result.residual = std::sqrt(squares / static_cast<double>(from.size()));
  result.overlap = static_cast<double>(from.size()) / static_cast<double>(moving.size());
}
// </solution>
