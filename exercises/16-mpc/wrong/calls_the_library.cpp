// caught by: forbidden-call
// mistake: lets the library plan.

// <solution headers>
#include "control/predictive_controller.h"
// </solution>

// <solution planned>
const PredictiveController controller({.A = task.plant.A, .B = task.plant.B, .step = 1.},
                                      {.Q = task.costs.Q,
                                       .R = task.costs.R,
                                       .F = task.costs.F,
                                       .horizon = task.N,
                                       .uMin = task.uMin,
                                       .uMax = task.uMax});
return controller.plan(x).U;
// </solution>
