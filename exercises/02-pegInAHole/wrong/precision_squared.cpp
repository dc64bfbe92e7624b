// caught by: stack
// mistake: The tasks are multiplied by their precisions instead of the square roots of them.

// <solution multiTaskStep>
Eigen::MatrixXd A = W;
Eigen::VectorXd b = Eigen::VectorXd::Zero(W.rows());
for (const TaskTerm& task : tasks) {
  A += task.precision * task.precision * task.J.transpose() * task.J;
  b -= task.precision * task.precision * task.J.transpose() * task.error;
}
return solve(A, b);
// </solution>
