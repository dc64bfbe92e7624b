// caught by: distance-zero, maps-other-robot
// mistake: The sum of the differences is one number, but zero on a whole plane through the goal.

// <solution distanceToGoal>
const Eigen::Vector3d away = S.kinematicsPos(body) - goal;
return {Eigen::VectorXd::Constant(1, away.sum()), S.jacobianPos(body).colwise().sum()};
// </solution>
