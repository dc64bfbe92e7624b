// caught by: trailer-moves
// mistake: takes the angle at the hitch for its sine.

// <solution rigVelocity>
velocity.head(3) = velocityOf(rig.car, q.head<3>(), speed, steering);
velocity[3] = speed / rig.hitchLength * (q[2] - q[3]);
// </solution>
