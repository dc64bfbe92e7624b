// caught by: follows
// shown by: follows
// mistake: applies the first gain of the preview to a change of the reference that is already past.

// <solution followed>
const Eigen::Index n = reference.size();
Eigen::MatrixXd states(3, n);
Eigen::Vector3d x(reference[0], 0, 0), change = Eigen::Vector3d::Zero();
double jerk = 0;
for (Eigen::Index k = 0; k < n; ++k) {
  states.col(k) = x;
  const double p = x[0] - cart.height / cart.g * x[2];
  jerk -= law.Gi * (p - reference[k]) + law.Gx.dot(change);
  for (Eigen::Index j = 1; j <= law.Gp.size() && k + j - 1 < n; ++j)
    if (k + j > 1) jerk += law.Gp[j - 1] * (reference[k + j - 1] - reference[k + j - 2]);
  change = cartStep(cart, x, jerk) - x;
  x += change;
}
return states;
// </solution>
