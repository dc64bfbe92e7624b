// caught by: car-spread, car-drift
// shown by: car-spread
// mistake: one random number for each particle, instead of three.

// <solution moved>
for (Eigen::Index i = 0; i < states.cols(); ++i)
  next.col(i) = carStep(states.col(i), u, world) + Eigen::Vector3d::Constant(world.dynamicsNoise *
                                                                             rng.normal());
// </solution>
