// caught by: outings
// shown by: outings
// mistake: moves the positions with the new velocities.

// <solution stepped>
const Eigen::Vector4d rate = rateOf(cart, x, u);
Eigen::Vector4d next = x + tau * rate;
next[1] += noise * rng.normal();
next[3] += noise * rng.normal();
next[0] = x[0] + tau * next[1];
next[2] = x[2] + tau * next[3];
return next;
// </solution>
