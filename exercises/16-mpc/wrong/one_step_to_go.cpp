// caught by: cost-to-go, more-to-go
// shown by: cost-to-go
// mistake: looks one step ahead only.

// <solution costToGo>
const auto &A = plant.A, &B = plant.B;
const Eigen::MatrixXd gain = solve(R + B.transpose() * Q * B, B.transpose() * Q * A);
return Q + A.transpose() * Q * (A - B * gain);
// </solution>
