// caught by: step
// shown by: ride
// mistake: one step of Euler, in which the positions move with the new velocities.

// <solution stepped>
Eigen::Vector4d next = x;
next.tail<2>() += tau * rateOf(x, u, racer).tail<2>();
next.head<2>() += tau * next.tail<2>();
return next;
// </solution>
