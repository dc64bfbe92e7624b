// caught by: filter-step, survives, tracks, consistent
// shown by: filter-step
// mistake: the particles move and are weighed, but never resampled.

// <solution filterStep>
after.states = moved(before.states, u, world, rng);
after.weights = weightsOf(logLikelihoods(after.states, y, world));
// </solution>
