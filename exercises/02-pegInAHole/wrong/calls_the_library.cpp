// caught by: forbidden-call
// mistake: The library knows strict priority, so nothing was learnt.

// <solution headers>
#include "kinematics/hierarchical_step.h"
// </solution>

// <solution priorityStep>
return hierarchicalStep({{J1, dy1}, {J2, dy2}});
// </solution>
