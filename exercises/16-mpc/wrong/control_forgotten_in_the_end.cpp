// caught by: cost-to-go, more-to-go
// mistake: adds up what states cost under the best controller, and not its controls.

// <solution costToGo>
const auto &A = plant.A, &B = plant.B;
Eigen::MatrixXd F = Q, states = Q;
for (int k = 0; k < 2000; ++k) {
  const Eigen::MatrixXd FB = F * B, gain = solve(R + B.transpose() * FB, FB.transpose() * A);
  const Eigen::MatrixXd closed = A - B * gain;
  const Eigen::MatrixXd before = Q + A.transpose() * F * closed;
  F = .5 * (before + before.transpose());
  states = (Q + closed.transpose() * states * closed).eval();
}
return states;
// </solution>
