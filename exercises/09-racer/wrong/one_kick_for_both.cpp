// caught by: noise
// mistake: the same number for both velocities.

// <solution kicks>
return std::sqrt(tau) * noise * rng.normalVector(steps).transpose().replicate(2, 1);
// </solution>
