// caught by: car-bearing
// mistake: the difference of two bearings is not wrapped: straight behind the car it is a whole turn.

// <solution viewGap>
gap[1] = y[1] - expected[1];
// </solution>
