// caught by: forbidden-call
// mistake: The library does the step, so nothing was learnt.

// <solution headers>
#include "kinematics/inverse_kinematics.h"
// </solution>

// <solution ikStep>
return inverseKinematicsStep(J, dy, sigma);
// </solution>
