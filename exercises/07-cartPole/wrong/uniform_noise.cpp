// caught by: outings
// mistake: the noise is uniform, with the right standard deviation.

// <solution stepped>
Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
next[1] += noise * std::sqrt(3.) * rng.uniform(-1, 1);
next[3] += noise * std::sqrt(3.) * rng.uniform(-1, 1);
return next;
// </solution>
