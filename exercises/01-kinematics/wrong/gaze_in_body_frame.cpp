// The gaze is a vector of the body's frame, the way to the target one of the world's: they cannot be
// compared. caught by: look-at-zero, maps-other-robot

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
return {gaze - toTarget, across* S.jacobianPos(body)};
// </solution>
