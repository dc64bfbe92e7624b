// caught by: gauss-newton, gauss-newton-elsewhere
// mistake: Gauss-Newton keeps its step size from step to step, as gradient descent does.

// <solution gaussNewton>
double alpha = 1;
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back(), value = phi(x);
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd g = 2 * Jx.transpose() * value;
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd d = -0.5 * solve(Jx.transpose() * Jx, g);
  while (!(phi(x + alpha * d).squaredNorm() <= value.squaredNorm() + options.decrease * alpha * g.dot(d)))
    alpha *= options.shrink;
  path.push_back(x + alpha * d);
  alpha = std::min(1., alpha * options.grow);
}
// </solution>
