// caught by: copies, more-copies
// mistake: all are copies of the best one.

// <solution resampled>
Eigen::Index best = 0;
weightsOf(particles).maxCoeff(&best);
const Particle& parent = particles[static_cast<std::size_t>(best)];
copies.assign(particles.size(), {parent.path, parent.map, 0});
// </solution>
