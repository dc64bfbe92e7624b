// caught by: distance-zero
// mistake: The derivative of the distance divides by the distance, which is zero at the goal.

// <solution distanceToGoal>
const Eigen::Vector3d away = S.kinematicsPos(body) - goal;
return {Eigen::VectorXd::Constant(1, away.norm()), away.transpose() * S.jacobianPos(body) / away.norm()};
// </solution>
