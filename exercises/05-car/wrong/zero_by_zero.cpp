// caught by: normalised, survives
// mistake: far particles and small noise make all likelihoods zero, and 0 / 0 of them weights.

// <solution weightsOf>
for (Eigen::Index i = 0; i < weights.size(); ++i) weights[i] = std::exp(logarithms[i]);
weights /= weights.sum();
// </solution>
