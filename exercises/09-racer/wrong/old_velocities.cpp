// caught by: step, energy
// mistake: one step of Euler.

// <solution stepped>
return x + tau * rateOf(x, u, racer);
// </solution>
