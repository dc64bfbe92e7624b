// caught by: weights
// mistake: the root of the sum of the squares.

// <solution effectiveSize>
return 1 / weights.norm();
// </solution>
