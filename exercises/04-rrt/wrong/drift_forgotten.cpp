// caught by: phase-effort, phase-step
// shown by: phase-effort
// mistake: without any force the point is taken to stay where it is.

// <solution effort>
const double position = to[0] - from[0], velocity = to[1] - from[1];
return 12 * position * position / (T * T * T) - 12 * position * velocity / (T * T) +
       4 * velocity * velocity / T;
// </solution>

// <solution forceAt>
const double position = to[0] - from[0], velocity = to[1] - from[1];
const double slope = 12 / (T * T * T) * position - 6 / (T * T) * velocity;
const double last = 4 / T * velocity - 6 / (T * T) * position;
return slope * (T - t) + last;
// </solution>
