// caught by: forbidden-call
// mistake: P and K of the library.

// <solution headers>
#include "control/regulators.h"
// </solution>

// <solution viaHamiltonian>
return lqr({.A = plant.A, .B = plant.B}, costs.Q, costs.R).X;
// </solution>
