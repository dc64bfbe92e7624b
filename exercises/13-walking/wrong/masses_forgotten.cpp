// caught by: stands, stands-any
// mistake: takes the mean position of all parts, whatever they weigh.

// <solution staticMargin>
Eigen::Vector2d sum = Eigen::Vector2d::Zero();
for (const MovingMass& part : robot) sum += part.p.head<2>();
return borderDistance(supportCorners(contacts), sum / static_cast<double>(robot.size()));
// </solution>
