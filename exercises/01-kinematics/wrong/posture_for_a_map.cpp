// caught by: look-at-jacobian, palms-jacobian, distance-jacobian, maps-other-robot
// mistake: the posture is a function of q with a simple Jacobian, but says nothing about the task.

// <solution lookAt>
return {S.getJointAngles(), Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension())};
// </solution>

// <solution opposePalms>
return {S.getJointAngles(), Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension())};
// </solution>

// <solution distanceToGoal>
return {S.getJointAngles().head(1), Eigen::MatrixXd::Identity(1, S.getJointDimension())};
// </solution>
