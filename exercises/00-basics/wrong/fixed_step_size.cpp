// caught by: descent, descent-elsewhere
// mistake: No line search: one small step size for all functions is too long for some and too short for
// others.

// <solution gradientDescent>
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd g = gradient(path.back());
  if (g.norm() <= options.tolerance) break;
  path.push_back(path.back() - 0.01 * g);
}
// </solution>
