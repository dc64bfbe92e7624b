// caught by: look-at-jacobian
// mistake: The direction to the target turns the other way: that part of the Jacobian has the wrong sign.

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) - across* S.jacobianPos(body)};
// </solution>
