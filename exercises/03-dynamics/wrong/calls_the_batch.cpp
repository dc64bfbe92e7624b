// caught by: forbidden-call
// mistake: asks the library about an arm that happens to have the same size, as one state of many.

// <solution headers>
#include "dynamics/dynamics_batch.h"
// </solution>

// <solution newtonEuler>
DynamicsWorkspace workspace;
inverseDynamicsBatch(Simulator("pegArm2.ors").model(), q, v, a, gravity, workspace, u);
// </solution>
