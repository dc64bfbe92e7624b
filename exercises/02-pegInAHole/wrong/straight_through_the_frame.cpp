// caught by: peg-insert, peg-other-hole
// mistake: The straight line in joint space from here into the hole leads through its walls.

// <solution insertPeg>
const Eigen::VectorXd start = S.getJointAngles();
pegPosture(S, peg, inside - 0.6 * direction, direction, margin);
postures = jointSpaceMotion(start, pegPosture(S, peg, inside, direction, margin), 400);
// </solution>
