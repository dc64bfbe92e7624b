// caught by: line, motion-other-robot
// mistake: The hand is sent to the far target at once, at every step.

// <solution straightLine>
for (int t = 1; t <= T; ++t) {
  S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma));
  postures.push_back(S.getJointAngles());
}
// </solution>
