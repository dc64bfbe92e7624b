// caught by: star-parent
// shown by: star-parent
// mistake: the slide as printed: candidates are compared with the first cost, not with the best so far.

// <solution bestParent>
double first = -1;
for (const int i : near) {
  const auto k = static_cast<std::size_t>(i);
  const double cost = tree.costs[k] + (tree.nodes[k] - q).norm();
  if (!edgeFree(tree.nodes[k], q)) continue;
  if (first < 0) first = cost;
  if (cost <= first) best = ParentChoice{i, cost};
}
// </solution>
