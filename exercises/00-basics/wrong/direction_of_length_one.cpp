// caught by: descent, descent-elsewhere
// mistake: The direction is normalised, so that alpha is the length of a step.

// <solution gradientDescent>
double alpha = 1;
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back(), g = gradient(x);
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd d = -g / g.norm();
  while (!(f(x + alpha * d) <= f(x) + options.decrease * alpha * g.dot(d))) alpha *= options.shrink;
  path.push_back(x + alpha * d);
  alpha *= options.grow;
}
// </solution>
