// caught by: places, any-places
// shown by: places
// mistake: normals point out of the object.

// <solution search>
namespace {

PlanarFinger fingerAlong(const std::vector<Eigen::Vector2d>& corners, double place, double friction) {
  const auto n = static_cast<double>(corners.size());
  place -= n * std::floor(place / n);
  const std::size_t i = std::min(static_cast<std::size_t>(place), corners.size() - 1);
  const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
  const double size = side.norm(), part = place - static_cast<double>(i);
  const double along = std::clamp(part * size, 0.0021, size - 0.0021);
  return {corners[i] + along / size * side, {side.y() / size, -side.x() / size}, friction};
}

}  // namespace
// </solution>
