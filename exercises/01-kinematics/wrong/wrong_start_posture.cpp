// caught by: small-steps, full-steps
// mistake: Every step starts again from the first posture instead of the outcome of the step before.

// <solution smallSteps>
Simulator fresh = S;
const Eigen::VectorXd q = S.getJointAngles();
fresh.setJointAngles(q + alpha * ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma));
postures.push_back(fresh.getJointAngles());
// </solution>
