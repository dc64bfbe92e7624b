// The direction to the target turns the other way when the body moves: its part of the Jacobian has the wrong
// sign. caught by: look-at-jacobian

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) - across* S.jacobianPos(body)};
// </solution>
