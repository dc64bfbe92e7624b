// caught by: car-spread
// mistake: draws from a copy of the generator, so that each call draws the same noise.

// <solution moved>
Rng own = rng;
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * own.normalVector(3);
// </solution>
