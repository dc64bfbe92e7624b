// caught by: effective-size
// mistake: one over the norm of the weights, not over its square.

// <solution effectiveSize>
return 1 / weights.norm();
// </solution>
