// caught by: iterates
// mistake: stops when P changes little in a step, but a step is epsilon times the bracket.

// <solution iterated>
const Eigen::MatrixXd S = plant.B * solve(costs.R, plant.B.transpose());
Eigen::MatrixXd P = costs.Q, bracket;
for (int k = 0; k <= most; ++k) {
  bracket = plant.A.transpose() * P + P * plant.A - P * S * P + costs.Q;
  if (epsilon * bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
  P += epsilon * bracket;
}
return {};
// </solution>
