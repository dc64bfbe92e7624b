// caught by: weights
// mistake: the sum of the squares, not one over it.

// <solution effectiveSize>
return weights.squaredNorm();
// </solution>
