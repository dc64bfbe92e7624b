// caught by: forbidden-call
// mistake: the library's distance in phase space.

// <solution headers>
#include "planning/phase_space.h"
// </solution>

// <solution effort>
return leastEffort(from, to, T);
// </solution>
