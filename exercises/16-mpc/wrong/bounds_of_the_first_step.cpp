// caught by: plan, more-plans
// mistake: only the first control has bounds.

// <solution planned>
const Eigen::Index m = task.uMin.size();
Eigen::VectorXd lower = Eigen::VectorXd::Constant(m * task.N, -1e6), upper = -lower;
lower.head(m) = task.uMin;
upper.head(m) = task.uMax;
return boxed(planCost(task.plant, task.costs, task.N, x), lower, upper).reshaped(m, task.N);
// </solution>
