// caught by: peg-straight
// mistake: The peg goes straight down, but nothing keeps the elbow away from the frame.

// <solution taskSpaceMotion>
const Eigen::Vector3d start = S.kinematicsPos(peg), direction = S.kinematicsVec(peg);
for (int t = 1; t <= T; ++t) {
  const Eigen::Vector3d wanted = start + sineProfile(static_cast<double>(t) / T) * (place - start);
  const TaskTerm there{S.kinematicsPos(peg) - wanted, S.jacobianPos(peg), 1e4};
  const TaskTerm straight{S.kinematicsVec(peg) - direction, S.jacobianVec(peg), 1e4};
  S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight}, W));
  postures.push_back(S.getJointAngles());
}
// </solution>
