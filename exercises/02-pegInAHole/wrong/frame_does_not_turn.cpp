// caught by: frames, other-robots
// mistake: Of the frame, only the point moves; the change of its axes is left out.

// <solution relativePosition>
Eigen::Matrix3d R;
for (int k = 0; k < 3; ++k) R.col(k) = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
y = R.transpose() * (S.kinematicsPos(body, inBody) - S.kinematicsPos(frame, inFrame));
J = R.transpose() * (S.jacobianPos(body, inBody) - S.jacobianPos(frame, inFrame));
// </solution>
