// caught by: circle
// shown by: circle
// mistake: The circle lies flat in the plane of x and y instead of standing in that of x and z.

// <solution circle>
const double angle = t / 20.;
const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), wanted - S.kinematicsPos(body), sigma));
postures.push_back(S.getJointAngles());
// </solution>
