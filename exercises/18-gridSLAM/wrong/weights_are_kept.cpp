// caught by: copies
// mistake: copies keep the weight that they were chosen for.

// <solution resampled>
const Eigen::VectorXd shares = weightsOf(particles);
const auto count = static_cast<double>(particles.size());
// Points one apart, along a line on which particle i is N weight_i long.
double point = rng.uniform(), end = 0;
for (std::size_t i = 0; i < particles.size(); ++i) {
  end += count * shares[static_cast<Eigen::Index>(i)];
  const bool isLast = i + 1 == particles.size();
  for (; copies.size() < particles.size() && (isLast || point < end); point += 1)
    copies.push_back({particles[i].path, particles[i].map, particles[i].logWeight});
}
// </solution>
