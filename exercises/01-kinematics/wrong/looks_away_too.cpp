// caught by: look-at-zero
// mistake: The cross product of gaze and direction is zero also when the body looks away from the target.

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
const Eigen::Vector3d seen = S.kinematicsVec(body, gaze);
const auto crossMatrix = [](const Eigen::Vector3d& w) {
  return (Eigen::Matrix3d() << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0).finished();
};
const Eigen::MatrixXd J =
    -crossMatrix(toTarget) * S.jacobianVec(body, gaze) - crossMatrix(seen) * across * S.jacobianPos(body);
return {crossMatrix(seen) * toTarget, J};
// </solution>
