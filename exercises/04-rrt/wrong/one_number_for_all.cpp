// caught by: step-target
// mistake: one random number for all coordinates: targets on the diagonal of the box.

// <solution drawTarget>
if (rng.uniform() < settings.goalBias) return aim;
return settings.lower + rng.uniform() * (settings.upper - settings.lower);
// </solution>
