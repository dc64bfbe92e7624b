// caught by: star-parent
// shown by: star-parent
// mistake: the parent is the position in the list of near nodes, not the number of the node.

// <solution bestParent>
for (std::size_t i = 0; i < near.size(); ++i) {
  const auto k = static_cast<std::size_t>(near[i]);
  const double cost = tree.costs[k] + (tree.nodes[k] - q).norm();
  if ((!best || cost < best->cost) && edgeFree(tree.nodes[k], q))
    best = ParentChoice{static_cast<int>(i), cost};
}
// </solution>
