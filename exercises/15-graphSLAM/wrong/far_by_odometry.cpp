// caught by: robust-few, robust-many
// mistake: drops the loops whose ends lie more than 3 m apart by odometry, which drifts as far as that.

// <solution robustlyAdjusted>
std::erase_if(now.edges, [&](const MeasuredEdge& edge) {
  const auto ends = {static_cast<std::size_t>(edge.from), static_cast<std::size_t>(edge.to)};
  const Eigen::Vector3d apart = map.poses[*ends.begin()] - map.poses[*(ends.begin() + 1)];
  return edge.isLoop && apart.head<2>().norm() > 3;
});
now.poses = adjusted(now).poses;
// </solution>
