// caught by: forbidden-call
// mistake: takes the equation of motion from the library.

// <solution headers>
#include "control/racer_dynamics.h"
// </solution>

// <solution massMatrix>
return RacerDynamics{racer.r, racer.l, racer.mA, racer.mB, racer.IA, racer.IB, racer.g}.massMatrix(q);
// </solution>
