// caught by: hand-equations, hand-circle, hand-other-paths
// mistake: T F with the wrong sign.

// <solution operationalForce>
const Eigen::MatrixXd T = solve(M, task.J.transpose()).transpose();  // J M^-1, for M is symmetric
return solve(T.transpose() * task.C * T + H, T.transpose() * task.C * (task.ydd - task.bias - T * F));
// </solution>
