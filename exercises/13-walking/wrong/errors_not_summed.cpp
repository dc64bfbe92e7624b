// caught by: follows
// mistake: the law gives the jerk itself instead of its change.

// <solution followed>
const Eigen::Index n = reference.size();
Eigen::MatrixXd states(3, n);
Eigen::Vector3d x(reference[0], 0, 0), change = Eigen::Vector3d::Zero();
for (Eigen::Index k = 0; k < n; ++k) {
  states.col(k) = x;
  double jerk = -law.Gi * (x[0] - cart.height / cart.g * x[2] - reference[k]) - law.Gx.dot(change);
  for (Eigen::Index j = 1; j <= law.Gp.size() && k + j < n; ++j)
    jerk += law.Gp[j - 1] * (reference[k + j] - reference[k + j - 1]);
  change = cartStep(cart, x, jerk) - x;
  x += change;
}
return states;
// </solution>
