// caught by: wrenches, all-wrenches
// mistake: torques in newton metres beside forces in newtons.

// <solution planarWrench>
const Eigen::Vector2d arm = p - center;
return {force.x(), force.y(), arm.x() * force.y() - arm.y() * force.x()};
// </solution>
