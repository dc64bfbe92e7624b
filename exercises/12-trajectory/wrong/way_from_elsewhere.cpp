// caught by: around-the-ball, around-others
// shown by: around-the-ball
// mistake: takes the postures that once led around the ball of the README, wherever the ball is.

// <solution aroundObstacle>
Eigen::MatrixXd points(3, 5);
points.transpose() << 0.5061, 0.3163, 0.3709, -0.0256, 0.4863, 0.6209, -0.5335, 0.5545, 0.7219, -0.7752,
    0.3907, 0.4814, errand.goal.transpose();
return throughPoints(S.getJointAngles(), points, {2, 5, 8, 11, errand.steps - 1}, errand.tau);
// </solution>
