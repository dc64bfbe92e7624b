// caught by: descent
// mistake: The step size only shrinks, so a shallow bowl takes for ever.

// <solution gradientDescent>
double alpha = 1;
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd g = gradient(path.back());
  if (g.norm() <= options.tolerance) break;
  alpha = backtracked(f, path.back(), -g, -g.squaredNorm(), alpha, options);
  path.push_back(path.back() - alpha * g);
}
// </solution>
