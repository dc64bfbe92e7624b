// caught by: plan-cost, more-costs
// mistake: forgets that the quadratic form has a factor of one half.

// <solution planCost>
const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
const Prediction p = predicted(plant, N);
Eigen::MatrixXd weighted = p.Su;
for (int t = 0; t < N; ++t)
  weighted.middleRows(t* n, n) = (t + 1 < N ? costs.Q : costs.F) * p.Su.middleRows(t * n, n);
Quadratic cost{p.Su.transpose() * weighted, weighted.transpose() * (p.Sx * x)};
for (int t = 0; t < N; ++t) cost.H.block(t* m, t* m, m, m) += costs.R;
return cost;
// </solution>
