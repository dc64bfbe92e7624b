// caught by: normalised, weights-anywhere, filter-step
// mistake: the largest weight is one, whatever their sum.

// <solution weightsOf>
const double largest = logarithms.maxCoeff();
for (Eigen::Index i = 0; i < weights.size(); ++i)
  weights[i] = std::isfinite(largest) ? std::exp(logarithms[i] - largest) : 1;
// </solution>
