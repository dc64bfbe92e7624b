// caught by: reach, any-reach
// shown by: reach
// mistake: measures how far the corners lie along the direction, which is not how far the hull reaches.

// <solution reachAlong>
return (wrenches.transpose() * direction).maxCoeff();
// </solution>
