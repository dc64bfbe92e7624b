// caught by: hamiltonian, other-regulators, survives
// shown by: hamiltonian
// mistake: the K of slide 8:18, for u = -K x.

// <solution gainOf>
return solve(costs.R, plant.B.transpose() * P);
// </solution>
