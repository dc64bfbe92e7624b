// caught by: likelihood, weights-anywhere, bearings
// mistake: divides the squared error by the noise, not by its square, as N(y | y', sigma) reads

// <solution logLikelihoods>
for (Eigen::Index i = 0; i < states.cols(); ++i) {
  const Eigen::VectorXd seen = viewFrom(states.col(i), world);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const bool isBearing = world.rangeBearing && k % 2 == 1;
    const double error = isBearing ? std::remainder(y[k] - seen[k], 2 * std::numbers::pi) : y[k] - seen[k];
    logarithms[i] -= error * error / (isBearing ? world.bearingNoise : world.observationNoise) / 2;
  }
}
// </solution>
