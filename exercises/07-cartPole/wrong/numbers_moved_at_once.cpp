// caught by: reach, reaches-others
// mistake: takes what B moves for what u reaches.

// <solution reachable>
const Eigen::VectorXd sizes = svd(plant.B).s;
return static_cast<int>((sizes.array() > 1e-9 * sizes[0]).count());
// </solution>
