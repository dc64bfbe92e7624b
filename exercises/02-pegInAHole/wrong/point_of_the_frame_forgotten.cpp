// caught by: frames, other-robots
// mistake: The vector begins at the origin of the frame.

// <solution relativePosition>
Eigen::Matrix3d R;
for (int k = 0; k < 3; ++k) R.col(k) = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
y = R.transpose() * (S.kinematicsPos(body, inBody) - S.kinematicsPos(frame));
J = R.transpose() * (S.jacobianPos(body, inBody) - S.jacobianPos(frame, y));
// </solution>
