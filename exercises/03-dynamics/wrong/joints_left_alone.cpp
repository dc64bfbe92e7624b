// caught by: hand-circle
// shown by: hand-circle
// mistake: nothing damps the joints that the hand leaves free.

// <solution followWithHand>
Eigen::MatrixXd M;
Eigen::VectorXd F;
S.getDynamics(M, F);
const Eigen::MatrixXd J = S.jacobianPos(hand);
const Eigen::VectorXd ydd = wantedAcceleration(S.kinematicsPos(hand), J* S.getJointVels(), reference, 0.1, 1);
const AccelerationTask task{J, accelerationBias(S, hand), ydd, 1e4 * Eigen::Matrix3d::Identity()};
return operationalForce(task, M, F, 1e-3 * Eigen::MatrixXd::Identity(n, n));
// </solution>
