// caught by: noise
// shown by: noise
// mistake: scales the noise by tau instead of its root.

// <solution kicks>
return tau * noise * rng.normalVector(2 * steps).reshaped(2, steps);
// </solution>
