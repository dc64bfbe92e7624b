// caught by: look-at-zero
// mistake: Differences of either sign can add up to zero although none of them is zero.

// <solution lookAt>
const Eigen::Vector3d way = target - S.kinematicsPos(body);
const Eigen::Vector3d toTarget = way.normalized();
const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
const Eigen::MatrixXd J = S.jacobianVec(body, gaze) + across * S.jacobianPos(body);
return {Eigen::VectorXd::Constant(1, (S.kinematicsVec(body, gaze) - toTarget).sum()), J.colwise().sum()};
// </solution>
