// caught by: cost-to-go, more-to-go
// mistake: takes five steps for all times to come.

// <solution costToGo>
const auto &A = plant.A, &B = plant.B;
Eigen::MatrixXd F = Q;
for (int k = 0; k < 5; ++k) {
  const Eigen::MatrixXd FB = F * B, gain = solve(R + B.transpose() * FB, FB.transpose() * A);
  F = Q + A.transpose() * F * (A - B * gain);
}
return F;
// </solution>
