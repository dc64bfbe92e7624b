// caught by: bearings, finds-heading
// shown by: bearings
// mistake: a difference of bearings loses one whole turn at most.

// <solution logLikelihoods>
for (Eigen::Index i = 0; i < states.cols(); ++i) {
  const Eigen::VectorXd seen = viewFrom(states.col(i), world);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const bool isBearing = world.rangeBearing && k % 2 == 1;
    double error = y[k] - seen[k];
    if (isBearing && error > std::numbers::pi) error -= 2 * std::numbers::pi;
    if (isBearing && error < -std::numbers::pi) error += 2 * std::numbers::pi;
    error /= isBearing ? world.bearingNoise : world.observationNoise;
    logarithms[i] -= error * error / 2;
  }
}
// </solution>
