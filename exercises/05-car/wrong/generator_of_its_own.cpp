// caught by: car-spread
// mistake: moved makes a generator with a fixed seed, so that the noise is the same in each step.

// <solution moved>
Rng own(7);
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * own.normalVector(3);
// </solution>
