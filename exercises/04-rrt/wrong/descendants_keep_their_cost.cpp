// caught by: star-rewired, star-worlds, star-shortest
// shown by: star-rewired
// mistake: a node with a new parent becomes cheaper, but its descendants keep their old costs.

// <solution rewired>
const auto n = static_cast<std::size_t>(node);
for (const int i : near) {
  const auto k = static_cast<std::size_t>(i);
  const double cost = tree.costs[n] + (tree.nodes[k] - tree.nodes[n]).norm();
  if (cost >= tree.costs[k] || !edgeFree(tree.nodes[n], tree.nodes[k])) continue;
  tree.parents[k] = node;
  tree.costs[k] = cost;
}
// </solution>
