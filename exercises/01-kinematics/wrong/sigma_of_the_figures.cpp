// caught by: motion-other-robot
// mistake: The circle always uses the sigma of main().

// <solution circle>
const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), wanted - S.kinematicsPos(body), 0.01));
postures.push_back(S.getJointAngles());
// </solution>
