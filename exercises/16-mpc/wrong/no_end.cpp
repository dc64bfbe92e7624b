// caught by: plan-cost, more-costs
// shown by: plan-cost
// mistake: weighs the last state like all others.

// <solution planCost>
const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
const Prediction p = predicted(plant, N);
Eigen::MatrixXd weighted = p.Su;
for (int t = 0; t < N; ++t) weighted.middleRows(t* n, n) = costs.Q * p.Su.middleRows(t * n, n);
Quadratic cost{2 * p.Su.transpose() * weighted, 2 * weighted.transpose() * (p.Sx * x)};
for (int t = 0; t < N; ++t) cost.H.block(t* m, t* m, m, m) += 2 * costs.R;
return cost;
// </solution>
