// caught by: drive, more-drives
// shown by: drive
// mistake: plans once, and follows this plan to its end.

// <solution driven>
const Eigen::MatrixXd plan = planned(task, start);
for (Eigen::Index t = 0; t < T; ++t) {
  if (t < task.N) drive.U.col(t) = plan.col(t);
  drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) + pushes.col(t);
}
// </solution>
