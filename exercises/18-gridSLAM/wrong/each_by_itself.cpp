// caught by: copies, more-copies
// mistake: each copy is drawn by itself.

// <solution resampled>
const Eigen::VectorXd weights = weightsOf(particles);
for (std::size_t n = 0; n < particles.size(); ++n) {
  double point = rng.uniform();
  std::size_t k = 0;
  while (k + 1 < particles.size() && point >= weights[static_cast<Eigen::Index>(k)])
    point -= weights[static_cast<Eigen::Index>(k++)];
  copies.push_back({particles[k].path, particles[k].map, 0});
}
// </solution>
