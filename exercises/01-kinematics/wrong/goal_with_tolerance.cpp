// caught by: distance-zero, maps-other-robot
// mistake: A guard against dividing by zero makes the map zero within a centimetre of the goal.

// <solution distanceToGoal>
const Eigen::Vector3d way = S.kinematicsPos(body) - goal;
const double distance = way.norm();
if (distance < 0.01) return {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, S.getJointDimension())};
return {Eigen::VectorXd::Constant(1, distance), way.transpose() * S.jacobianPos(body) / distance};
// </solution>
