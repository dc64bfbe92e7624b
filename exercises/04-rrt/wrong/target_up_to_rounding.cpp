// caught by: step-nearest
// mistake: a near target is reached only up to rounding, so that it goes unnoticed when the trees meet.

// <solution stepTowards>
const double distance = (target - from).norm();
return distance > 0 ? from + std::min(distance, stepSize) * ((target - from) / distance) : target;
// </solution>
