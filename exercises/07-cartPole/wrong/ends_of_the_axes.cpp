// caught by: lyapunov
// mistake: Of each axis only its end is tested.

// <solution counterexample>
const Eigen::Index n = high.size();
const auto disproves = [&](const Eigen::VectorXd& x) { return x.dot(P * x) <= 0 || x.dot(P * f(x)) >= 0; };
for (Eigen::Index i = 0; i < n; ++i) {
  const Eigen::VectorXd x = high[i] * Eigen::VectorXd::Unit(n, i);
  if (disproves(x)) return x;
}
for (int k = 0; k < 10000; ++k) {
  const Eigen::VectorXd x = rng.uniformVector(static_cast<int>(n), -1, 1).cwiseProduct(high);
  if (disproves(x)) return x;
}
return {};
// </solution>
