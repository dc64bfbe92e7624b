// caught by: peg-other-hole
// mistake: The peg points downwards, whatever direction is asked for.

// <solution pegPosture>
const int n = S.getJointDimension();
const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
for (int i = 0; i < 1000; ++i) {
  const Eigen::Vector3d down(0, 0, -1);
  const TaskTerm there{0.02 * (S.kinematicsPos(peg) - place), S.jacobianPos(peg), 1e4};
  const TaskTerm straight{0.02 * (S.kinematicsVec(peg) - down), S.jacobianVec(peg), 1e4};
  const TaskTerm apart{S.kinematicsContacts(), S.jacobianContacts(), 100};
  S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight, apart}, W));
}
return S.getJointAngles();
// </solution>
