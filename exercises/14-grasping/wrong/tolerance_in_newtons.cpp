// caught by: cones, any-cones
// mistake: the tolerance is in newtons instead of relative to the size of the force.

// <solution inCone>
const double normal = force.dot(finger.normal), along = (force - normal * finger.normal).norm();
return along <= finger.friction * normal + 1e-9;
// </solution>
