// caught by: trailer-moves
// mistake: the trailer turns away from the car.

// <solution rigVelocity>
velocity.head(3) = velocityOf(rig.car, q.head<3>(), speed, steering);
velocity[3] = speed / rig.hitchLength * std::sin(q[3] - q[2]);
// </solution>

// <solution hitchGrowth>
return speed / rig.hitchLength;
// </solution>
