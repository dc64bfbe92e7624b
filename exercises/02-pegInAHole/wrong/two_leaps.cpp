// caught by: peg-insert, peg-other-hole
// shown by: peg-insert
// mistake: No posture touches anything, but from one to the next the peg jumps.

// <solution insertPeg>
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::VectorXd above = pegPosture(S, peg, inside - 0.6 * direction, direction, margin);
postures = jointSpaceMotion(start, above, 200);
postures.push_back(pegPosture(S, peg, inside, direction, margin));
// </solution>
