// caught by: lyapunov
// mistake: does not check that V is positive.

// <solution counterexample>
const auto n = static_cast<int>(high.size());
for (int k = 0; k < 10000; ++k) {
  Eigen::VectorXd x = high.cwiseProduct(rng.uniformVector(n, -1, 1));
  if (k < n) x = high[k] * Eigen::VectorXd::Unit(n, k);
  if (x.dot(P * f(x)) >= 0) return x;
}
return {};
// </solution>
