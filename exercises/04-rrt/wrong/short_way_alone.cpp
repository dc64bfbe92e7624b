// caught by: star-thin-walls, star-worlds, star-shortest
// shown by: star-thin-walls
// mistake: no RRT*, but the shortened path of two trees as a tree of one branch.

// <solution growStar>
Path way;
double least = std::numeric_limits<double>::infinity();
for (int i = 0; i < 4; ++i) {
  Path one = growBoth(start, goal, settings, edgeFree, rng).path;
  for (int k = 0; k < 12; ++k) one = shortened(one, edgeFree, rng);
  double length = 0;
  for (std::size_t k = 1; k < one.size(); ++k) length += (one[k] - one[k - 1]).norm();
  if (length >= least) continue;
  least = length;
  way = one;
}
Tree& tree = search.tree;
for (std::size_t i = 1; i < way.size(); ++i) {
  const Eigen::VectorXd step = way[i] - way[i - 1];
  const int count = static_cast<int>(std::ceil(step.norm() / settings.stepSize));
  for (int k = 1; k <= count; ++k) {
    const Eigen::VectorXd before = tree.nodes.back(), q = k == count ? way[i] : way[i - 1] + k * step / count;
    edgeFree(before, q);
    tree.parents.push_back(static_cast<int>(tree.nodes.size()) - 1);
    tree.costs.push_back(tree.costs.back() + (q - before).norm());
    tree.nodes.push_back(q);
  }
}
search.goal = static_cast<int>(tree.nodes.size()) - 1;
search.best.assign(static_cast<std::size_t>(settings.maxSamples), tree.costs.back());
// </solution>
