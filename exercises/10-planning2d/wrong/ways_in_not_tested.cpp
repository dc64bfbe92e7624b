// caught by: prm-slot, prm-query
// mistake: joins start and goal to nodes behind blocks, too.

// <solution queryRoadmap>
Network all = roadmap;
all.resize(nodes.size() + 2);
std::vector<Eigen::Vector2d> points = nodes;
for (const Eigen::Vector2d& q : {start, goal}) {
  const std::size_t me = points.size();
  for (std::size_t j : nearestNodes(nodes, q, k)) {
    all[me].push_back({j, (q - nodes[j]).norm()});
    all[j].push_back({me, (q - nodes[j]).norm()});
  }
  points.push_back(q);
}
for (std::size_t i : wayDown(all, dijkstra(all, points.size() - 1), points.size() - 2))
  way.push_back(points[i]);
// </solution>
