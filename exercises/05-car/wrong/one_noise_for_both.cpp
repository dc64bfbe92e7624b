// caught by: bearings, finds-heading
// mistake: bearings are weighed with the noise of distances.

// <solution logLikelihoods>
for (Eigen::Index i = 0; i < states.cols(); ++i) {
  const Eigen::VectorXd seen = viewFrom(states.col(i), world);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const bool isBearing = world.rangeBearing && k % 2 == 1;
    const double error = isBearing ? std::remainder(y[k] - seen[k], 2 * std::numbers::pi) : y[k] - seen[k];
    logarithms[i] -= error * error / (2 * world.observationNoise * world.observationNoise);
  }
}
// </solution>
