// caught by: quick-others
// mistake: lets the gains grow.

// <solution quickGains>
Eigen::MatrixXd best = start;
double rate = slowest(start), size = bound / 10;
for (int asked = 1; asked < 3000; ++asked) {
  const Eigen::MatrixXd K = best + size * rng.normalVector(static_cast<int>(start.size())).transpose();
  const double found = slowest(K);
  if (found < rate) best = K, rate = found;
}
return best;
// </solution>
