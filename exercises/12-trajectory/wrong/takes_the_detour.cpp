// caught by: around-the-ball, around-others
// shown by: around-the-ball
// mistake: takes the detour, and optimises nothing.

// <solution aroundObstacle>
const Eigen::VectorXd start = S.getJointAngles();
const int last = errand.steps - 1;
Eigen::MatrixXd points(start.size(), 2);
points << errand.detour, errand.goal;
return throughPoints(start, points, {last / 2, last}, errand.tau);
// </solution>
