// caught by: iterates
// mistake: returns the last P, even if it has not converged.

// <solution iterated>
const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
Eigen::MatrixXd P = costs.Q, bracket;
for (int k = 0; k <= most; ++k) {
  bracket = plant.A.transpose() * P + P * plant.A - P * S * P + costs.Q;
  if (bracket.cwiseAbs().maxCoeff() <= tolerance) break;
  P += epsilon * bracket;
}
return P;
// </solution>
