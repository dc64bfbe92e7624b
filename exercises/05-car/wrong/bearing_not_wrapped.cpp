// caught by: bearings
// mistake: a landmark directly behind is seen on the left and expected on the right, a whole turn off.

// <solution logLikelihoods>
for (Eigen::Index i = 0; i < states.cols(); ++i) {
  const Eigen::VectorXd seen = viewFrom(states.col(i), world);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const bool isBearing = world.rangeBearing && k % 2 == 1;
    const double error = (y[k] - seen[k]) / (isBearing ? world.bearingNoise : world.observationNoise);
    logarithms[i] -= error * error / 2;
  }
}
// </solution>
