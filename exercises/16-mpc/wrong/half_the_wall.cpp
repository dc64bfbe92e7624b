// caught by: wall, more-walls
// shown by: wall
// mistake: forgets the factor of one half in the quadratic form.

// <solution plannedWithin>
const Prediction p = predicted(task.plant, task.N);
const Quadratic plain = planCost(task.plant, task.costs, task.N, x);
const Eigen::Index controls = p.Su.cols(), states = p.Su.rows();
const Eigen::VectorXd drift = p.Sx * x;
const Eigen::MatrixXd cross = -corridor.weight * p.Su;
Quadratic both{Eigen::MatrixXd::Zero(controls + states, controls + states),
               Eigen::VectorXd(controls + states)};
both.H << plain.H - cross.transpose() * p.Su,
    cross.transpose(), cross, corridor.weight* Eigen::MatrixXd::Identity(states, states);
both.g << plain.g - cross.transpose() * drift, -corridor.weight* drift;
Eigen::VectorXd lower(controls + states), upper(controls + states);
lower << task.uMin.replicate(task.N, 1), corridor.xMin.replicate(task.N, 1);
upper << task.uMax.replicate(task.N, 1), corridor.xMax.replicate(task.N, 1);
return boxed(both, lower, upper).head(controls).reshaped(task.uMin.size(), task.N);
// </solution>
