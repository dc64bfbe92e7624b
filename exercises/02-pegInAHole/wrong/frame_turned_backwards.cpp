// caught by: frames, other-robots
// shown by: frames
// mistake: R instead of its transpose.

// <solution relativePosition>
Eigen::Matrix3d R;
for (int k = 0; k < 3; ++k) R.col(k) = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
const Eigen::Vector3d d = S.kinematicsPos(body, inBody) - S.kinematicsPos(frame, inFrame);
y = R * d;
J = R * (S.jacobianPos(body, inBody) - S.jacobianPos(frame, R.transpose() * d + inFrame));
// </solution>
