// The hand is sent to the far target at once, at every step.
// caught by: line, motion-other-robot

// <solution straightLine>
S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma));
postures.push_back(S.getJointAngles());
// </solution>
