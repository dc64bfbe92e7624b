// caught by: capture
// shown by: capture
// mistake: the velocity times omega instead of divided by it.

// <solution capturePoint>
return now.c + now.v * std::sqrt(pendulum.g / pendulum.height);
// </solution>
