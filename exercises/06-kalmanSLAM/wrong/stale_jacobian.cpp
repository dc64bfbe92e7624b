// caught by: kf-step, kf-any
// mistake: the view is linearised at the state before the step.

// <solution tracked>
const Belief moved = predicted(car, belief, u);
const Eigen::Vector3d x = moved.mean;
const Eigen::Index m = y.size();
Eigen::VectorXd gap(m);
Eigen::MatrixXd C(m, 3), W = Eigen::MatrixXd::Zero(m, m);
for (Eigen::Index i = 0; i < m; i += 2) {
  const Eigen::Vector2d l = landmarks.col(i / 2), seen(y[i], y[i + 1]);
  gap.segment(i, 2) = viewGap(car, seen, view(car, x, l));
  C.middleRows(i, 2) = viewByState(car, belief.mean, l);
  W.block(i, i, 2, 2) = viewNoise(car);
}
return corrected(moved, gap, C, W);
// </solution>
