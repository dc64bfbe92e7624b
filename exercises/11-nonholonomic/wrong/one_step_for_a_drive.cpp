// caught by: car-moves, car-any
// shown by: car-moves
// mistake: drives straight on along the heading at the start.

// <solution driven>
return q + drive.seconds * velocityOf(car, q, drive.speed, drive.steering);
// </solution>
