// caught by: full-steps, small-steps, motion-other-robot
// mistake: Each posture is kept before its step instead of after it.

// <solution smallSteps>
postures.push_back(S.getJointAngles());
const Eigen::VectorXd dq = ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma);
S.setJointAngles(S.getJointAngles() + alpha * dq);
// </solution>
