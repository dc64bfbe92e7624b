// caught by: connect-plane, connect-worlds
// shown by: connect-plane
// mistake: the random steps of both trees aim at the start with the goalBias.

// <solution growBoth>
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
  if (!grow(one, drawTarget(settings, start, rng))) continue;
  const Eigen::VectorXd met = one.nodes.back();
  while (grow(other, met))
    if (other.nodes.back() == met) {
      search.path = joinedPath(search.fromStart, static_cast<int>(search.fromStart.nodes.size()) - 1,
                               search.fromGoal, static_cast<int>(search.fromGoal.nodes.size()) - 1);
      return search;
    }
}
// </solution>
