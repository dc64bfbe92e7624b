// caught by: quick, quick-others
// mistake: calls slowest() twice per step.

// <solution quickGains>
Eigen::MatrixXd best = start;
for (int k = 0; k < 3000; ++k) {
  const double size = bound * std::pow(.998, k) / 5;
  const Eigen::MatrixXd move = size * rng.normalVector(static_cast<int>(start.size())).transpose();
  const Eigen::MatrixXd K = (best + move).cwiseMin(bound).cwiseMax(-bound);
  if (slowest(K) < slowest(best)) best = K;
}
return best;
// </solution>
