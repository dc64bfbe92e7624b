// caught by: circle-home
// mistake: With the precision of the circle, home holds the hand back.

// <solution circleWithTasks>
const Eigen::VectorXd home = S.getJointAngles();
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  const Eigen::VectorXd q = S.getJointAngles();
  const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
  const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 100};
  const TaskTerm stayAtHome{q - home, W, 1e4};
  S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
  postures.push_back(S.getJointAngles());
}
// </solution>
