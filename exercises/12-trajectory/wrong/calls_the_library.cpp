// caught by: forbidden-call
// mistake: uses the library's terms.

// <solution headers>
#include "trajectory/motion_terms.h"
// </solution>

// <solution differenceTerm>
const std::vector<TrajectoryTerm> terms{velocityTerm(), accelerationTerm(), jerkTerm()};
FunctionValue value;
terms[static_cast<std::size_t>(window.cols()) - 2].function({.t = 0, .tau = tau, .X = window}, value);
return {value.y, value.J};
// </solution>
