// caught by: impact, step, other-steps, gait
// shown by: step
// mistake: nothing happens in an impact but that the legs swap roles.

// <solution impactOf>
return {x[1], x[0], x[3], x[2]};
// </solution>
