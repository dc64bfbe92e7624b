// caught by: forbidden-call
// mistake: Differences give the numbers of a Jacobian without deriving it.

// <solution distanceToGoal>
const auto distance = [&](const Eigen::VectorXd& q) -> Eigen::VectorXd {
  Simulator there = S;
  there.setJointAngles(q);
  return Eigen::VectorXd::Constant(1, (there.kinematicsPos(body) - goal).squaredNorm());
};
return {distance(S.getJointAngles()), numericJacobian(distance, S.getJointAngles())};
// </solution>
