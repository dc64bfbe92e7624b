// caught by: trailer-reverses, trailer-any
// shown by: trailer-reverses
// mistake: steers towards the axis, as if the car drove forward.

// <solution reverseSteering>
const double offset = q[1] - rig.hitchLength * std::sin(q[3]);
return std::clamp(-0.3 * offset - 1.2 * q[3], rig.car.minSteering, rig.car.maxSteering);
// </solution>
