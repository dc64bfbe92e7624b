// caught by: quick-others
// mistake: draws gains anywhere in the box and keeps the best.

// <solution quickGains>
Eigen::MatrixXd best = start;
double rate = slowest(start);
for (int asked = 1; asked < 3000; ++asked) {
  const Eigen::MatrixXd K = rng.uniformVector(static_cast<int>(start.size()), -bound, bound).transpose();
  const double found = slowest(K);
  if (found < rate) best = K, rate = found;
}
return best;
// </solution>
