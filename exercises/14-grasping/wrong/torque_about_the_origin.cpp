// caught by: wrenches, all-wrenches
// mistake: takes the torque about the origin, whatever the center is.

// <solution planarWrench>
return {force.x(), force.y(), (p.x() * force.y() - p.y() * force.x()) / length};
// </solution>

// <solution spatialWrench>
wrench << force, p.cross(force) / length;
// </solution>
