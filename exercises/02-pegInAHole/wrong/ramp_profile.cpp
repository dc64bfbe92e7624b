// caught by: interpolation, peg-straight
// mistake: A ramp instead of the sine: it starts and stops with a jerk.

// <solution sineProfile>
return s;
// </solution>
