// caught by: wrenches, all-wrenches
// mistake: the product of slide 10:6 as it is printed, force x arm.

// <solution planarWrench>
const Eigen::Vector2d arm = p - center;
return {force.x(), force.y(), (force.x() * arm.y() - force.y() * arm.x()) / length};
// </solution>

// <solution spatialWrench>
wrench << force, force.cross(p - center) / length;
// </solution>
