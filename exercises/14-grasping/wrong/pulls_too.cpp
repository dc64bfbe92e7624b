// caught by: cones, any-cones
// mistake: forgets that a finger only pushes.

// <solution inCone>
const double along = std::abs(force.dot(finger.normal));
return (force - force.dot(finger.normal) * finger.normal).norm() <=
       finger.friction * along + 1e-9 * force.norm();
// </solution>
