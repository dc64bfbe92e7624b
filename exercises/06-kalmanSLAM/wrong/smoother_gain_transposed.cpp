// caught by: rts-batch, rts-better
// mistake: the gain of the smoother is transposed.

// <solution hindsight>
for (std::size_t t = controls.size(); t-- > 0;) {
  const Belief &now = filtered[t], &later = smooth[t + 1], moved = predicted(car, now, controls[t]);
  // How a correction at t + 1 carries over to t: the regression of x(t) on x(t + 1).
  const Eigen::MatrixXd AS = stepByState(car, now.mean, controls[t]) * now.covariance;
  const Eigen::MatrixXd G = solveMatrix(moved.covariance, AS);
  const Eigen::MatrixXd change = later.covariance - moved.covariance, GS = G * change;
  const Eigen::VectorXd shift = later.mean - moved.mean;
  smooth[t].mean = now.mean + G * shift;
  smooth[t].covariance = symmetric(now.covariance + GS * G.transpose());
}
// </solution>
