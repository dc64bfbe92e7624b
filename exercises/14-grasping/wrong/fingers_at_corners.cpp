// caught by: places, any-places
// shown by: places
// mistake: puts fingers onto corners, where there is no normal.

// <solution search>
namespace {

PlanarFinger fingerAlong(const std::vector<Eigen::Vector2d>& corners, double place, double friction) {
  const auto n = static_cast<double>(corners.size());
  place -= n * std::floor(place / n);
  const std::size_t i = std::min(static_cast<std::size_t>(place), corners.size() - 1);
  const Eigen::Vector2d ahead = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
  return {corners[i], {-ahead.y(), ahead.x()}, friction};
}

}  // namespace
// </solution>
