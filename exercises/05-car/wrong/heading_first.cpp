// caught by: car-step, car-spread
// mistake: the car turns first, and then drives in its new direction.

// <solution carStep>
const double way = world.tau * u[0], heading = x[2] + way / world.wheelbase * std::tan(u[1]);
return {x[0] + way * std::cos(heading), x[1] + way* std::sin(heading), heading};
// </solution>
