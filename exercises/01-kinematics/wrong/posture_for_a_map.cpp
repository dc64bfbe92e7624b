// caught by: look-at-zero, look-at-jacobian, palms-zero, palms-jacobian, distance-zero, distance-jacobian,
// maps-other-robot mistake: The posture itself is a function of q, and its Jacobian is the identity; but it
// says nothing about the task.

// <solution lookAt>
return {S.getJointAngles(), Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension())};
// </solution>

// <solution opposePalms>
return {S.getJointAngles(), Eigen::MatrixXd::Identity(S.getJointDimension(), S.getJointDimension())};
// </solution>

// <solution distanceToGoal>
return {S.getJointAngles().head(1), Eigen::MatrixXd::Identity(1, S.getJointDimension())};
// </solution>
