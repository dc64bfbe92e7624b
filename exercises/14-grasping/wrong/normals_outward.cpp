// caught by: places, any-places
// shown by: places
// mistake: normals point out of the object.

// <solution search>
namespace {

std::vector<PlanarFinger> placesOn(const std::vector<Eigen::Vector2d>& corners, double friction, int each) {
  std::vector<PlanarFinger> places;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
    const Eigen::Vector2d ahead = side.normalized();
    const double room = side.norm() - 0.006;
    for (int k = 0; room > 0 && k <= each; ++k)
      places.push_back({corners[i] + (0.003 + room * k / each) * ahead, {ahead.y(), -ahead.x()}, friction});
  }
  return places;
}

}  // namespace
// </solution>
