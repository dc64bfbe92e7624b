// caught by: connect-plane, connect-worlds
// shown by: connect-plane
// mistake: the second tree steps towards the random target, in place of the new node.

// <solution growBoth>
SearchSettings unbiased = settings;
unbiased.goalBias = 0;
const auto grow = [&](Tree& tree, const Eigen::VectorXd& target) {
  const std::optional<NewNode> made = rrtStep(tree, target, settings.stepSize, edgeFree);
  if (!made) return false;
  tree.nodes.push_back(made->q);
  tree.parents.push_back(made->parent);
  return true;
};
for (int i = 0; i < settings.maxSamples; ++i) {
  Tree& one = i % 2 == 0 ? search.fromStart : search.fromGoal;
  Tree& other = i % 2 == 0 ? search.fromGoal : search.fromStart;
  const Eigen::VectorXd target = drawTarget(unbiased, start, rng);
  if (!grow(one, target) || !grow(other, target)) continue;
  if ((one.nodes.back() - other.nodes.back()).norm() <= settings.stepSize &&
      edgeFree(other.nodes.back(), one.nodes.back())) {
    search.path = joinedPath(search.fromStart, static_cast<int>(search.fromStart.nodes.size()) - 1,
                             search.fromGoal, static_cast<int>(search.fromGoal.nodes.size()) - 1);
    return search;
  }
}
// </solution>
