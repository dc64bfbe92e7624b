// caught by: outings
// mistake: takes the noise as noise per second.

// <solution stepped>
Eigen::Vector4d next = x + tau * rateOf(cart, x, u);
next[1] += std::sqrt(tau) * noise * rng.normal();
next[3] += std::sqrt(tau) * noise * rng.normal();
return next;
// </solution>
