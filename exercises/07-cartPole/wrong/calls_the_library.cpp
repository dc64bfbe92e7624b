// caught by: forbidden-call
// mistake: takes P and K from the library.

// <solution headers>
#include "control/regulators.h"
// </solution>

// <solution viaHamiltonian>
return lqr({.A = plant.A, .B = plant.B}, costs.Q, costs.R).X;
// </solution>
