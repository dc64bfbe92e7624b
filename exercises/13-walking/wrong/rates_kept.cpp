// caught by: impact, step, other-steps, gait
// shown by: step
// mistake: nothing happens in an impact but that the legs change their parts.

// <solution impactOf>
return {x[1], x[0], x[3], x[2]};
// </solution>
