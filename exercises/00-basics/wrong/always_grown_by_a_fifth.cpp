// caught by: descent-elsewhere
// mistake: The next trial is longer by a fifth, whatever `grow` says.

// <solution gradientDescent>
double alpha = 1;
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd g = gradient(path.back());
  if (g.norm() <= options.tolerance) break;
  alpha = backtracked(f, path.back(), -g, -g.squaredNorm(), alpha, options);
  path.push_back(path.back() - alpha * g);
  alpha *= 1.2;
}
// </solution>
