// caught by: sways
// mistake: a pendulum that hangs: cosine and sine.

// <solution swayed>
const double omega = std::sqrt(pendulum.g / pendulum.height), c = std::cos(omega * t),
             s = std::sin(omega * t);
return {p + c * (start.c - p) + s / omega * start.v, c* start.v - omega* s*(start.c - p)};
// </solution>
