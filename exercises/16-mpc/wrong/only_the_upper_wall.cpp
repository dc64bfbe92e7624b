// caught by: wall, more-walls
// mistake: only states above the corridor cost.

// <solution plannedWithin>
const Prediction p = predicted(task.plant, task.N);
const Eigen::VectorXd most = corridor.xMax.replicate(task.N, 1);
Quadratic cost = planCost(task.plant, task.costs, task.N, x);
const Quadratic plain = cost;
const Eigen::VectorXd lower = task.uMin.replicate(task.N, 1), upper = task.uMax.replicate(task.N, 1);
Eigen::VectorXd U = boxed(plain, lower, upper);
for (int round = 0; round < 50; ++round) {
  const Eigen::VectorXd X = p.Sx * x + p.Su * U;
  cost = plain;
  for (Eigen::Index i = 0; i < X.size(); ++i) {
    if (X[i] <= most[i]) continue;
    const Eigen::VectorXd row = p.Su.row(i);
    cost.H += 2 * corridor.weight * row * row.transpose();
    cost.g += 2 * corridor.weight * ((p.Sx.row(i) * x)(0) - most[i]) * row;
  }
  U = boxed(cost, lower, upper);
}
return U.reshaped(task.uMin.size(), task.N);
// </solution>
