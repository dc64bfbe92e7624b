// caught by: horizon, other-horizons
// mistake: begins with Q instead of F.

// <solution gainsOverTime>
const Eigen::MatrixXd &A = plant.A, &B = plant.B;
std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
Eigen::MatrixXd P = costs.Q;
for (auto k = K.rbegin(); k != K.rend(); ++k) {
  *k = -solve(costs.R + B.transpose() * P * B, B.transpose() * P * A);
  P = costs.Q + A.transpose() * P * (A + B * *k);
}
return K;
// </solution>
