// caught by: backward-plane, backward-worlds
// shown by: backward-plane
// mistake: a hard-coded bias.

// <solution growBackward>
SearchSettings typedIn = settings;
typedIn.goalBias = 0.5;
Tree& tree = search.tree;
for (int i = 0; i < settings.maxSamples; ++i) {
  const std::optional<NewNode> made =
      rrtStep(tree, drawTarget(typedIn, start, rng), settings.stepSize, edgeFree);
  if (!made) continue;
  tree.nodes.push_back(made->q);
  tree.parents.push_back(made->parent);
  if ((made->q - start).norm() > settings.stepSize || !edgeFree(made->q, start)) continue;
  search.path = wayFromRoot(tree, static_cast<int>(tree.nodes.size()) - 1);
  search.path.push_back(start);
  std::reverse(search.path.begin(), search.path.end());
  break;
}
// </solution>
