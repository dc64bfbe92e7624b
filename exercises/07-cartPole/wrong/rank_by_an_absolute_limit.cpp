// caught by: reach
// mistake: Singular values are compared with 1e-9 itself.

// <solution reachable>
return static_cast<int>((svd(reachMatrix(plant)).s.array() > 1e-9).count());
// </solution>
