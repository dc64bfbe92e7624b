// caught by: normalised, survives
// mistake: far particles and small noise make all likelihoods zero, and all weights 0 / 0.

// <solution weightsOf>
for (Eigen::Index i = 0; i < weights.size(); ++i) weights[i] = std::exp(logarithms[i]);
weights /= weights.sum();
// </solution>
