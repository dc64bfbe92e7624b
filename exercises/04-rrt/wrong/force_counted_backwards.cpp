// caught by: phase-effort
// shown by: phase-effort
// mistake: the slope of the force is multiplied by t, not by what is left of T.

// <solution forceAt>
const double position = to[0] - from[0] - T * from[1], velocity = to[1] - from[1];
const double slope = 12 / (T * T * T) * position - 6 / (T * T) * velocity;
const double last = 4 / T * velocity - 6 / (T * T) * position;
return slope * t + last;
// </solution>
