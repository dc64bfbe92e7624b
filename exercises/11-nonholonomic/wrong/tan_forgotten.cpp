// caught by: car-moves, car-any
// mistake: the front wheels turn the car by their angle, not by its tangent.

// <solution velocityOf>
return {speed * std::cos(q[2]), speed* std::sin(q[2]), speed / car.wheelbase* steering};
// </solution>
