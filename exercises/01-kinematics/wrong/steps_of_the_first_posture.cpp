// caught by: full-steps, small-steps, motion-other-robot
// mistake: The joint angles are added up, but S stays where it is.

// <solution smallSteps>
const Eigen::VectorXd q = t == 1 ? S.getJointAngles() : postures.back();
const Eigen::VectorXd dq = ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma);
postures.push_back(q + alpha * dq);
// </solution>
