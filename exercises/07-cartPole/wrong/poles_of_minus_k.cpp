// caught by: poles
// mistake: u = -K x in the closed loop.

// <solution slowestPole>
return eigenvalues(plant.A - plant.B * K).real().maxCoeff();
// </solution>
