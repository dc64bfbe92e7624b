// caught by: plan-cost, more-costs
// mistake: controls cost nothing.

// <solution planCost>
const Eigen::Index n = plant.A.rows();
const Prediction p = predicted(plant, N);
Eigen::MatrixXd weighted = p.Su;
for (int t = 0; t < N; ++t)
  weighted.middleRows(t* n, n) = (t + 1 < N ? costs.Q : costs.F) * p.Su.middleRows(t * n, n);
return {2 * p.Su.transpose() * weighted, 2 * weighted.transpose() * (p.Sx * x)};
// </solution>
