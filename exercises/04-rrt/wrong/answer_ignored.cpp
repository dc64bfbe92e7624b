// caught by: step-plane, step-corners, backward-plane
// shown by: step-plane
// mistake: edgeFree is called, but its answer is not used.

// <solution rrtStep>
const int nearest = nearestNode(tree.nodes, target);
const Eigen::VectorXd& from = tree.nodes[static_cast<std::size_t>(nearest)];
const Eigen::VectorXd q = stepTowards(from, target, stepSize);
edgeFree(from, q);
return NewNode{q, nearest};
// </solution>
