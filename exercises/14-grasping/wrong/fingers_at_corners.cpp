// caught by: places, any-places
// shown by: places
// mistake: puts fingers onto corners, where there is no normal.

// <solution search>
namespace {

std::vector<PlanarFinger> placesOn(const std::vector<Eigen::Vector2d>& corners, double friction, int) {
  std::vector<PlanarFinger> places;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d ahead = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
    places.push_back({corners[i], {-ahead.y(), ahead.x()}, friction});
  }
  return places;
}

}  // namespace
// </solution>
