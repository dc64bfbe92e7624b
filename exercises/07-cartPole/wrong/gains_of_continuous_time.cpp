// caught by: horizon, other-horizons
// mistake: K = -R^-1 B^T P, as in continuous time.

// <solution gainsOverTime>
const Eigen::MatrixXd &A = plant.A, &B = plant.B;
std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
Eigen::MatrixXd P = F;
for (auto k = K.rbegin(); k != K.rend(); ++k) {
  *k = -solve(costs.R, B.transpose() * P);
  const Eigen::MatrixXd M = costs.R + B.transpose() * P * B;
  P = costs.Q + A.transpose() * (P - P * B * solve(M, B.transpose() * P)) * A;
}
return K;
// </solution>
