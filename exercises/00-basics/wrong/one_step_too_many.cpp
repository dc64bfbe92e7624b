// caught by: gauss-newton
// mistake: The loop takes one step more than maxSteps.

// <solution gaussNewton>
for (int step = 0; step <= options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back(), value = phi(x);
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd g = 2 * Jx.transpose() * value;
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd d = -0.5 * solve(Jx.transpose() * Jx, g);
  double alpha = 1;
  while (!(phi(x + alpha * d).squaredNorm() <= value.squaredNorm() + options.decrease * alpha * g.dot(d)))
    alpha *= options.shrink;
  path.push_back(x + alpha * d);
}
// </solution>
