// caught by: trailer-reverses, trailer-any
// shown by: trailer-reverses
// mistake: turns the trailer away from the axis.

// <solution reverseSteering>
// From outside to inside, each orders the next: the offset a heading of the trailer, this an angle at the
// hitch, and this a steering angle. Rates are per metre of way; each is faster than the one outside.
const double trailer = std::remainder(q[3], 2 * std::numbers::pi);
const double hitch = std::remainder(q[2] - q[3], 2 * std::numbers::pi);
const double offset = q[1] - rig.hitchLength * std::sin(trailer);
const double heading = std::clamp(-0.15 * offset, -0.4, 0.4);
// Beyond d tan(steering) / L nothing folds the rig back: stay well below.
const double most = 0.6 * std::min(1., rig.hitchLength* std::tan(rig.car.maxSteering) / rig.car.wheelbase);
const double angle = std::clamp(rig.hitchLength * 0.5 * (trailer - heading), -most, most);
const double curvature = std::sin(hitch) / rig.hitchLength + 1.5 * (hitch - angle);
const double steering = std::atan(rig.car.wheelbase * curvature);
return std::clamp(steering, rig.car.minSteering, rig.car.maxSteering);
// </solution>
