// caught by: wrenches, all-wrenches
// mistake: takes the torque about the origin, whatever the center is.

// <solution planarWrench>
notUsedYet(center);
return {force.x(), force.y(), (p.x() * force.y() - p.y() * force.x()) / length};
// </solution>

// <solution spatialWrench>
notUsedYet(center);
wrench << force, p.cross(force) / length;
// </solution>
