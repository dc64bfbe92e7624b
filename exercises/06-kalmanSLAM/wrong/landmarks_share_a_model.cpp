// caught by: kf-step, kf-any, kf-track
// mistake: all sightings get the derivative of the first landmark.

// <solution tracked>
const Belief moved = predicted(car, belief, u);
const Eigen::Vector3d x = moved.mean;
const Eigen::Index m = y.size();
Eigen::VectorXd gap(m);
Eigen::MatrixXd C(m, 3), W = Eigen::MatrixXd::Zero(m, m);
for (Eigen::Index i = 0; i < m; i += 2) {
  const Eigen::Vector2d l = landmarks.col(i / 2), seen(y[i], y[i + 1]);
  gap.segment(i, 2) = viewGap(car, seen, view(car, x, l));
  C.middleRows(i, 2) = viewByState(car, x, landmarks.col(0));
  W.block(i, i, 2, 2) = viewNoise(car);
}
return corrected(moved, gap, C, W);
// </solution>
