// caught by: backward-plane, backward-worlds
// mistake: The edge from the last node to the start is not tested.

// <solution growBackward>
Tree& tree = search.tree;
for (int i = 0; i < settings.maxSamples; ++i) {
  const auto made = rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
  if (!made) continue;
  tree.nodes.push_back(made->q);
  tree.parents.push_back(made->parent);
  if ((made->q - start).norm() > settings.stepSize) continue;
  search.path = wayFromRoot(tree, static_cast<int>(tree.nodes.size()) - 1);
  search.path.push_back(start);
  std::reverse(search.path.begin(), search.path.end());
  break;
}
// </solution>
