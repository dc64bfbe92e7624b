// caught by: car-spread, car-drift, filter-step
// shown by: car-spread
// mistake: noise is drawn once per step, so that the cloud moves as a whole and never grows.

// <solution moved>
const Eigen::Vector3d noise = world.dynamicsNoise * rng.normalVector(3);
for (Eigen::Index i = 0; i < states.cols(); ++i) next.col(i) = carStep(states.col(i), u, world) + noise;
// </solution>
