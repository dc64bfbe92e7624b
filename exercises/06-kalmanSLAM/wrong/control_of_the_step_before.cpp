// caught by: rts-batch
// shown by: rts-batch
// mistake: goes back with the control that led to t, in place of the one that leads from it.

// <solution hindsight>
for (std::size_t t = controls.size(); t-- > 0;) {
  const Belief &now = filtered[t], &later = smooth[t + 1],
               moved = predicted(car, now, controls[t > 0 ? t - 1 : 0]);
  // How a correction at t + 1 carries over to t: the regression of x(t) on x(t + 1).
  const Eigen::MatrixXd AS = stepByState(car, now.mean, controls[t > 0 ? t - 1 : 0]) * now.covariance;
  const Eigen::MatrixXd G = solveMatrix(moved.covariance, AS).transpose();
  const Eigen::MatrixXd change = later.covariance - moved.covariance, GS = G * change;
  const Eigen::VectorXd shift = later.mean - moved.mean;
  smooth[t].mean = now.mean + G * shift;
  smooth[t].covariance = symmetric(now.covariance + GS * G.transpose());
}
// </solution>
