// caught by: gains
// shown by: gains
// mistake: the K of slide 8:18, for u = -K x.

// <solution gainOf>
return solve(costs.R, plant.B.transpose() * P);
// </solution>
