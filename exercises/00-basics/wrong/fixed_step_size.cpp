// caught by: descent, descent-elsewhere
// mistake: no line search: one small step size is too long for some functions and too short for others

// <solution gradientDescent>
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd g = gradient(path.back());
  if (g.norm() <= options.tolerance) break;
  path.push_back(path.back() - 0.01 * g);
}
// </solution>
