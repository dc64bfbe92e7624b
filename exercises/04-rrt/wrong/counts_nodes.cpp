// caught by: backward-plane, backward-worlds
// mistake: maxSamples limits the nodes instead of the targets.

// <solution growBackward>
Tree& tree = search.tree;
while (static_cast<int>(tree.nodes.size()) < settings.maxSamples) {
  const auto made = rrtStep(tree, drawTarget(settings, start, rng), settings.stepSize, edgeFree);
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
