// caught by: hand-equations
// mistake: the step of the differences is as large as tau.

// <solution accelerationBias>
// How J changes along the motion, by a difference to both sides.
const Eigen::VectorXd q = S.getJointAngles(), v = S.getJointVels();
const double h = 0.01;
S.setJointAngles(q + h * v);
const Eigen::MatrixXd later = S.jacobianPos(body);
S.setJointAngles(q);
return (later - S.jacobianPos(body)) * v / h;
// </solution>
