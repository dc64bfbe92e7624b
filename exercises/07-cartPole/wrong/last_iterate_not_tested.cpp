// caught by: iterates, other-regulators
// mistake: The loop ends before P_most is looked at.

// <solution iterated>
const Eigen::MatrixXd G = plant.B * inverse(costs.R) * plant.B.transpose();
Eigen::MatrixXd P = costs.Q;
for (int k = 0; k < most; ++k) {
  const Eigen::MatrixXd bracket = plant.A.transpose() * P + P * plant.A - P * G * P + costs.Q;
  if (bracket.cwiseAbs().maxCoeff() <= tolerance) return P;
  P += epsilon * bracket;
}
return {};
// </solution>
