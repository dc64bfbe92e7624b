// caught by: backward-plane, backward-arm, backward-worlds
// shown by: backward-plane
// mistake: the path ends with the node beside the start.

// <solution growBackward>
Tree& tree = search.tree;
for (int i = 0; i < settings.maxSamples; ++i) {
  const std::optional<NewNode> made =
      rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
  if (!made) continue;
  tree.nodes.push_back(made->q);
  tree.parents.push_back(made->parent);
  if ((made->q - start).norm() > settings.stepSize || !edgeFree(made->q, start)) continue;
  search.path = wayFromRoot(tree, static_cast<int>(tree.nodes.size()) - 1);
  std::reverse(search.path.begin(), search.path.end());
  break;
}
// </solution>
