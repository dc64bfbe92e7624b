// caught by: weights
// mistake: the sum is not one.

// <solution weightsOf>
for (std::size_t i = 0; i < particles.size(); ++i)
  weights[static_cast<Eigen::Index>(i)] = particles[i].logWeight;
weights = (weights.array() - weights.maxCoeff()).exp().eval();
// </solution>
