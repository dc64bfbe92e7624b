// caught by: car-step, car-spread, car-drift
// shown by: car-step
// mistake: the rate of theta is taken for its change.

// <solution carStep>
const double way = world.tau * u[0];
return {x[0] + way * std::cos(x[2]), x[1] + way* std::sin(x[2]),
        x[2] + u[0] / world.wheelbase* std::tan(u[1])};
// </solution>
