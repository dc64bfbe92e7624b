// caught by: descent, descent-elsewhere
// mistake: Rejected trials count as steps.

// <solution gradientDescent>
double alpha = 1;
for (int trial = 0; trial < options.maxSteps; ++trial) {
  const Eigen::VectorXd x = path.back(), g = gradient(x);
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd next = x - alpha * g;
  const bool isBetter = f(next) <= f(x) - options.decrease * alpha * g.squaredNorm();
  if (isBetter) path.push_back(next);
  alpha *= isBetter ? options.grow : options.shrink;
}
// </solution>
