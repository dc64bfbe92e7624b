// caught by: drive, more-drives
// mistake: leaves out the pushes.

// <solution driven>
for (Eigen::Index t = 0; t < T; ++t) {
  drive.U.col(t) = planned(task, drive.X.col(t)).col(0);
  drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t);
}
// </solution>
