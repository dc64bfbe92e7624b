// caught by: rts-batch
// mistake: takes the next belief of the filter where the smoothed one belongs.

// <solution hindsight>
for (std::size_t t = controls.size(); t-- > 0;) {
  const Belief &now = filtered[t], &later = filtered[t + 1], moved = predicted(car, now, controls[t]);
  // How a correction at t + 1 carries over to t: the regression of x(t) on x(t + 1).
  const Eigen::MatrixXd AS = stepByState(car, now.mean, controls[t]) * now.covariance;
  const Eigen::MatrixXd G = solveMatrix(moved.covariance, AS).transpose();
  const Eigen::MatrixXd change = later.covariance - moved.covariance, GS = G * change;
  const Eigen::VectorXd shift = later.mean - moved.mean;
  smooth[t].mean = now.mean + G * shift;
  smooth[t].covariance = symmetric(now.covariance + GS * G.transpose());
}
// </solution>
