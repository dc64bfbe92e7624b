// caught by: scan-align
// shown by: scan-align
// mistake: reports the fit for partners up to twice as far away as asked.

// <solution aligned>
for (int iteration = 0; iteration < 60; ++iteration) {
  // Partners far away help at first; later they only pull at what is hidden from the other scan.
  const double reach = std::max(0.6, 0.9 * std::pow(0.9, iteration));
  const std::vector<int> numbers = partners(reference, moving, result.motion, reach);
  Points from, to;
  for (std::size_t k = 0; k < moving.size(); ++k)
    if (numbers[k] >= 0) {
      from.push_back(moving[k]);
      to.push_back(reference[static_cast<std::size_t>(numbers[k])]);
    }
  if (from.size() < 3) break;
  const Eigen::Vector3d before = result.motion;
  result.motion = bestMotion(from, to);
  double squares = 0;
  const double c = std::cos(result.motion[2]), s = std::sin(result.motion[2]);
  for (std::size_t k = 0; k < from.size(); ++k)
    squares += std::pow(result.motion[0] + c * from[k].x() - s * from[k].y() - to[k].x(), 2) +
               std::pow(result.motion[1] + s * from[k].x() + c * from[k].y() - to[k].y(), 2);
  result.residual = std::sqrt(squares / static_cast<double>(from.size()));
  result.overlap = static_cast<double>(from.size()) / static_cast<double>(moving.size());
  if (reach == 0.6 && (result.motion - before).norm() < 1e-6) break;
}
// </solution>
