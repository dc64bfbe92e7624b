// caught by: full-steps, small-steps, motion-other-robot
// mistake: The Jacobian is computed once, before the first step.

// <solution smallSteps>
static Eigen::MatrixXd J;
if (t == 1) J = S.jacobianPos(body);
S.setJointAngles(S.getJointAngles() + alpha * ikStep(J, target - S.kinematicsPos(body), sigma));
postures.push_back(S.getJointAngles());
// </solution>
