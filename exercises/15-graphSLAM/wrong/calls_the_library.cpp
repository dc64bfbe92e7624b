// caught by: forbidden-call
// mistake: lets the library find the best map.

// <solution headers>
#include "estimation/pose_graph.h"
// </solution>

// <solution adjusted>
PlanarPoseGraph graph{Eigen::Matrix3Xd(3, static_cast<Eigen::Index>(map.poses.size())), {}};
for (std::size_t k = 0; k < map.poses.size(); ++k)
  graph.poses.col(static_cast<Eigen::Index>(k)) = map.poses[k];
for (const MeasuredEdge& edge : map.edges)
  graph.edges.push_back({edge.from, edge.to, edge.motion, edge.information});
result.costs.push_back(optimize(graph).cost);
for (std::size_t k = 0; k < map.poses.size(); ++k)
  result.poses[k] = graph.poses.col(static_cast<Eigen::Index>(k));
// </solution>
