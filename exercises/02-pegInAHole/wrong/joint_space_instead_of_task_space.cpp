// caught by: peg-straight
// mistake: Both ends are right, but between them the peg leaves its line.

// <solution taskSpaceMotion>
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::Vector3d direction = S.kinematicsVec(peg);
postures = jointSpaceMotion(start, pegPosture(S, peg, place, direction, margin), T);
// </solution>
