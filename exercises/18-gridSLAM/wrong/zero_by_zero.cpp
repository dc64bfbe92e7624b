// caught by: weights
// mistake: exp() of large negative numbers is zero for all.

// <solution weightsOf>
for (std::size_t i = 0; i < particles.size(); ++i)
  weights[static_cast<Eigen::Index>(i)] = particles[i].logWeight;
weights = weights.array().exp().eval();
weights /= weights.sum();
// </solution>
