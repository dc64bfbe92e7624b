// caught by: look-at-zero
// mistake: Two coordinates of a direction leave the sign of the third open: a mirror image gives zero too.

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
const Eigen::MatrixXd J = S.jacobianVec(body, gaze) + across * S.jacobianPos(body);
return {(S.kinematicsVec(body, gaze) - toTarget).head(2), J.topRows(2)};
// </solution>
