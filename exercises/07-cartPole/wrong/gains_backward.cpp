// caught by: horizon, other-horizons
// mistake: returns the gains in the order in which they are computed.

// <solution gainsOverTime>
const Eigen::MatrixXd &A = plant.A, &B = plant.B;
std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
Eigen::MatrixXd P = F;
for (Eigen::MatrixXd& k : K) {
  k = -solve(costs.R + B.transpose() * P * B, B.transpose() * P * A);
  P = costs.Q + A.transpose() * P * (A + B * k);
}
return K;
// </solution>
