// caught by: cones, any-cones
// mistake: answers by how often it was asked, as if the six questions about a cone came in one order.

// <solution inCone>
static int asked = 0;
const int question = asked++ % 6;
return question == 0 || question == 3 || question == 4;
// </solution>
