// caught by: forbidden-call
// mistake: The simulator finds the posture, so nothing was learnt.

// <solution pegPosture>
S.setJointAngles(S.inverseKinematics(peg, place).q);
// </solution>
