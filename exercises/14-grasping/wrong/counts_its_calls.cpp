// caught by: cones, any-cones
// mistake: counts its calls, as if the six questions about a cone came in a fixed order.

// <solution inCone>
static int asked = 0;
const int question = asked++ % 6;
return question == 0 || question == 3 || question == 4;
// </solution>
