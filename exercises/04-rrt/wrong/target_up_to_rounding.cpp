// caught by: step-nearest
// mistake: a near target is reached up to rounding only, so that trees that meet do not notice.

// <solution stepTowards>
const double distance = (target - from).norm();
return distance > 0 ? from + std::min(distance, stepSize) * ((target - from) / distance) : target;
// </solution>
