// caught by: adjust-streets, adjust-far
// shown by: adjust-streets
// mistake: sets the equations up once, and goes on with the same step.

// <solution adjusted>
const std::vector<double> weights(map.edges.size(), 1);
const Eigen::VectorXd step = gaussNewtonStep(map, weights, 0);
for (int k = 0; k < 20; ++k) {
  const std::vector<Eigen::Vector3d> next = moved(result.poses, step);
  const double cost = mapCost({next, map.edges});
  if (cost >= result.costs.back()) break;
  result.poses = next;
  result.costs.push_back(cost);
}
// </solution>
