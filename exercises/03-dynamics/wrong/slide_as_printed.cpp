// caught by: hand-equations
// mistake: the factor 2 of slide 3:33.

// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();  // J M^-1, for M is symmetric
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd - 2 * task.bias + T * F));
// </solution>
