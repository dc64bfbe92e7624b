// caught by: forbidden-call
// mistake: asks the library about an arm that happens to have the same size.

// <solution headers>
#include "dynamics/inverse_dynamics.h"
// </solution>

// <solution newtonEuler>
u = inverseDynamics(Simulator("pegArm2.ors").model(), q, v, a, gravity);
// </solution>
