// caught by: peg-other-hole
// mistake: The peg comes from above, wherever the hole points.

// <solution insertPeg>
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::VectorXd above = pegPosture(S, peg, inside + Eigen::Vector3d(0, 0, 0.6), direction, margin);
postures = jointSpaceMotion(start, above, 200);
S.setJointAngles(above);
for (const Eigen::VectorXd& q : taskSpaceMotion(S, peg, inside, margin, 200)) postures.push_back(q);
// </solution>
