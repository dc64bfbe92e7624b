// caught by: forbidden-call
// mistake: asks the library for the curve.

// <solution headers>
#include "planning/dubins.h"
// </solution>

// <solution shortestDubins>
const Curve curve = dubinsCurve(from, to, radius);
for (std::size_t i = 0; i < 3; ++i) best.lengths[i] = curve.segments()[i].length;
for (int i = 0; i < 6; ++i)
  if (std::array{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"}[static_cast<std::size_t>(i)] == curve.word())
    best.word = static_cast<DubinsWord>(i);
// </solution>
