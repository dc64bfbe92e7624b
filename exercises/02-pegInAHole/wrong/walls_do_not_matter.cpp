// caught by: peg-posture
// mistake: Position and direction are right, but the arm overlaps the frame.

// <solution pegPosture>
const int n = S.getJointDimension();
const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
for (int i = 0; i < 1000; ++i) {
  const TaskTerm there{0.02 * (S.kinematicsPos(peg) - place), S.jacobianPos(peg), 1e4};
  const TaskTerm straight{0.02 * (S.kinematicsVec(peg) - direction), S.jacobianVec(peg), 1e4};
  S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight}, W));
}
// </solution>
