// caught by: circle, motion-other-robot
// mistake: The angle counts from zero, so the hand is always where it should have been a step ago.

// <solution circle>
const double angle = (t - 1) / 20.;
const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(angle), 0, std::sin(angle));
S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), wanted - S.kinematicsPos(body), sigma));
postures.push_back(S.getJointAngles());
// </solution>
