// caught by: loop-rooms, loop-any, robust-few, robust-many
// mistake: accepts every second pair of scans, and only exact loops; looks neither at scans nor at the map.

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
