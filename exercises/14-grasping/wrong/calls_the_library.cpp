// caught by: forbidden-call
// mistake: the library measures the quality.

// <solution headers>
#include "grasping/quality.h"
// </solution>

// <solution epsilonOf>
return graspQuality(wrenches).epsilon;
// </solution>
