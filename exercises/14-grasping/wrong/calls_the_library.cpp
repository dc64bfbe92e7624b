// caught by: forbidden-call
// mistake: lets the library measure the quality.

// <solution headers>
#include "grasping/quality.h"
// </solution>

// <solution epsilonOf>
return graspQuality(wrenches).epsilon;
// </solution>
