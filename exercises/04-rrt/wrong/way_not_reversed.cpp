// caught by: backward-way, backward-arm, backward-worlds, connect-joined
// mistake: parents are followed from the node to the root, and the path keeps that order.

// <solution wayFromRoot>
for (int i = node; i >= 0; i = tree.parents[static_cast<std::size_t>(i)])
  path.push_back(tree.nodes[static_cast<std::size_t>(i)]);
// </solution>
