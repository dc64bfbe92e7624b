// caught by: drive, more-drives
// mistake: uses the last control of each plan.

// <solution driven>
for (Eigen::Index t = 0; t < T; ++t) {
  drive.U.col(t) = planned(task, drive.X.col(t)).rightCols(1);
  drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) + pushes.col(t);
}
// </solution>
