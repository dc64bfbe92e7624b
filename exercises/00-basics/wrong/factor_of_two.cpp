// caught by: gauss-newton
// mistake: the gradient has its factor of two, the Hessian does not: every step is twice too long

// <solution gaussNewton>
const auto f = [&](const Eigen::VectorXd& x) { return phi(x).squaredNorm(); };
for (int step = 0; step < options.maxSteps; ++step) {
  const Eigen::VectorXd x = path.back();
  const Eigen::MatrixXd Jx = J(x);
  const Eigen::VectorXd g = 2 * Jx.transpose() * phi(x);
  if (g.norm() <= options.tolerance) break;
  const Eigen::VectorXd d = -solve(Jx.transpose() * Jx, g);
  path.push_back(x + backtracked(f, x, d, g.dot(d), 1, options) * d);
}
// </solution>
