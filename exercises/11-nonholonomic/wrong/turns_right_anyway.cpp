// caught by: park-left, park-left-any
// mistake: forgets that some cars turn left only.

// <solution park>
CarModel any = car;
any.minSteering = -car.maxSteering;
return parkInSteps(any, lot, 0.4);
// </solution>
