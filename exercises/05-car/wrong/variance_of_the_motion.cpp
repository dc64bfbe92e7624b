// caught by: car-spread, car-drift, filter-step
// shown by: car-spread
// mistake: the root of dynamicsNoise, as if that were a variance.

// <solution moved>
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + std::sqrt(world.dynamicsNoise) * rng.normalVector(3);
// </solution>
