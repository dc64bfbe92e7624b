// caught by: gauss-newton, gauss-newton-elsewhere
// shown by: gauss-newton
// mistake: Always the full step: where phi bends, it leads away.

// <solution gaussNewton>
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back();
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd halfGradient = Jx.transpose() * phi(x);
  if (2 * halfGradient.norm() <= options.tolerance) break;
  path.push_back(x - solve(Jx.transpose() * Jx, halfGradient));
}
// </solution>
