// caught by: look-at-zero, maps-other-robot
// mistake: The gaze is given in the body's frame, but the direction to the target in the world's.

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
return {gaze - toTarget, across* S.jacobianPos(body)};
// </solution>
