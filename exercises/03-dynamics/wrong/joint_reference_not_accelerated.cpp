// caught by: torque-equations, torque-other-arm
// mistake: the acceleration of the reference is missing.

// <solution wantedAcceleration>
return (reference.y - y) / (lambda * lambda) + 2 * xi / lambda * (reference.yd - yd);
// </solution>
