// caught by: impact, step, other-steps, gait
// shown by: step
// mistake: the impact does nothing but swap the roles of the legs.

// <solution impactOf>
return {x[1], x[0], x[3], x[2]};
// </solution>
