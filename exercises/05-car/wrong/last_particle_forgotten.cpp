// caught by: car-spread, car-drift, filter-step
// shown by: car-spread
// mistake: the loop ends one particle early.

// <solution moved>
for (Eigen::Index i = 0; i < states.cols() - 1; ++i)
  next.col(i) = carStep(states.col(i), u, world) + world.dynamicsNoise * rng.normalVector(3);
// </solution>
