// caught by: star-thin-walls, star-worlds, star-shortest
// shown by: star-thin-walls
// mistake: targets go on to aim at the goal after it has become a node.

// <solution growStar>
Tree& tree = search.tree;
for (int i = 0; i < settings.maxSamples; ++i) {
  const Eigen::VectorXd target = drawTarget(settings, goal, rng);
  const int nearest = nearestNode(tree.nodes, target);
  const Eigen::VectorXd from = tree.nodes[static_cast<std::size_t>(nearest)];
  const Eigen::VectorXd q = stepTowards(from, target, settings.stepSize);
  const double n = static_cast<double>(tree.nodes.size());
  const double reach =
      std::min(settings.stepSize, gamma * std::pow(std::log(n) / n, 1. / static_cast<double>(q.size())));
  std::vector<int> near{nearest};
  for (int k = 0; k < static_cast<int>(tree.nodes.size()); ++k)
    if (k != nearest && (tree.nodes[static_cast<std::size_t>(k)] - q).norm() <= reach) near.push_back(k);
  if (const std::optional<ParentChoice> choice = bestParent(tree, near, q, edgeFree)) {
    const int node = static_cast<int>(tree.nodes.size());
    tree.nodes.push_back(q);
    tree.parents.push_back(choice->parent);
    tree.costs.push_back(choice->cost);
    tree = rewired(std::move(tree), near, node, edgeFree);
    if (search.goal < 0 && q == goal) search.goal = node;
  }
  search.best.push_back(search.goal < 0 ? std::numeric_limits<double>::infinity()
                                        : tree.costs[static_cast<std::size_t>(search.goal)]);
}
// </solution>
