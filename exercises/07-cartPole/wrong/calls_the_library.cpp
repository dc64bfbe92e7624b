// caught by: forbidden-call
// mistake: P and K of the library.

// <solution viaHamiltonian>
return lqr({.A = plant.A, .B = plant.B}, costs.Q, costs.R).X;
// </solution>
