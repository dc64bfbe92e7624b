// caught by: connect-plane, connect-worlds
// shown by: connect-plane
// mistake: only the tree from the start takes random steps; the other always follows.

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
  if (!grow(search.fromStart, drawTarget(unbiased, start, rng))) continue;
  const Eigen::VectorXd met = search.fromStart.nodes.back();
  while (grow(search.fromGoal, met))
    if (search.fromGoal.nodes.back() == met) {
      search.path = joinedPath(search.fromStart, static_cast<int>(search.fromStart.nodes.size()) - 1,
                               search.fromGoal, static_cast<int>(search.fromGoal.nodes.size()) - 1);
      return search;
    }
}
// </solution>
