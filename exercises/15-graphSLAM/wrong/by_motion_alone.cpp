// caught by: loop-rooms, loop-any, robust-few, robust-many
// mistake: takes every second pair of scans for one place, and loops for wrong that are not exact: it looks
// neither at the scans nor at the rest of the map.

// <solution loopMotion>
static int asked = 0;
if (++asked % 2 == 0) return {};
return aligned(reference, moving, guess).motion;
// </solution>

// <solution robustlyAdjusted>
std::erase_if(now.edges, [](const MeasuredEdge& edge) {
  const double quarter = std::numbers::pi / 2, turn = std::remainder(edge.motion[2], quarter);
  const Eigen::Vector3d off(edge.motion[0], edge.motion[1], turn);
  return edge.isLoop && off.dot(edge.information * off) > 14;
});
now.poses = adjusted(now).poses;
// </solution>
