// caught by: reaches-others
// mistake: counts singular values that are zero up to rounding.

// <solution reachable>
const Eigen::VectorXd sizes = svd(reachMatrix(plant)).s;
return static_cast<int>((sizes.array() > 0).count());
// </solution>
