// caught by: plan, more-plans
// mistake: takes the first N numbers for the first control.

// <solution planned>
const Eigen::VectorXd U = boxed(planCost(task.plant, task.costs, task.N, x), task.uMin.replicate(task.N, 1),
                                task.uMax.replicate(task.N, 1));
return U.reshaped(task.N, task.uMin.size()).transpose();
// </solution>
