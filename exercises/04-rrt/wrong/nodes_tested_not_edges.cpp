// caught by: step-plane, step-corners, backward-worlds, connect-worlds
// mistake: lines 6 and 7 of the slides as printed: only the new node has to be free.

// <solution rrtStep>
const int nearest = nearestNode(tree.nodes, target);
const Eigen::VectorXd q = stepTowards(tree.nodes[static_cast<std::size_t>(nearest)], target, stepSize);
if (!edgeFree(q, q)) return {};
return NewNode{q, nearest};
// </solution>
