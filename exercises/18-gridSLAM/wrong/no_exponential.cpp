// caught by: weights
// mistake: logarithms are taken for weights.

// <solution weightsOf>
for (std::size_t i = 0; i < particles.size(); ++i)
  weights[static_cast<Eigen::Index>(i)] = particles[i].logWeight;
weights /= weights.sum();
// </solution>
