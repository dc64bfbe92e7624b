// caught by: drive, more-drives
// mistake: plans again only when a plan is used up.

// <solution driven>
Eigen::MatrixXd plan;
for (Eigen::Index t = 0; t < T; ++t) {
  if (t % task.N == 0) plan = planned(task, drive.X.col(t));
  drive.U.col(t) = plan.col(t % task.N);
  drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) + pushes.col(t);
}
// </solution>
