// caught by: lyapunov
// mistake: tries random points only, and takes V' = 0 for falling.

// <solution counterexample>
for (int k = 0; k < 10000; ++k) {
  const Eigen::VectorXd x = high.cwiseProduct(rng.uniformVector(static_cast<int>(high.size()), -1, 1));
  if (x.dot(P * x) <= 0 || x.dot(P * f(x)) > 0) return x;
}
return {};
// </solution>
