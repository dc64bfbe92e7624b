// caught by: circle-home, circle-points
// mistake: the precisions of pointing and home are exchanged.

// <solution circleWithTasks>
const Eigen::VectorXd home = S.getJointAngles();
for (int k = 1; k <= T; ++k) {
  const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(k / 20.), 0, std::sin(k / 20.));
  const Eigen::VectorXd q = S.getJointAngles();
  const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
  const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 0.01};
  const TaskTerm stayAtHome{q - home, W, 100};
  S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
  postures.push_back(S.getJointAngles());
}
// </solution>
