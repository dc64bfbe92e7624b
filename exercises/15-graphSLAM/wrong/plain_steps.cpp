// caught by: adjust-far
// mistake: takes plain steps, whether or not the cost rises.

// <solution adjusted>
PoseMap now = map;
for (int k = 0; k < 20; ++k) {
  now.poses = moved(now.poses, gaussNewtonStep(now, std::vector<double>(map.edges.size(), 1), 0));
  result.costs.push_back(mapCost(now));
  if (std::abs(result.costs[result.costs.size() - 2] - result.costs.back()) < 1e-10 * result.costs.back())
    break;
}
result.poses = now.poses;
// </solution>
