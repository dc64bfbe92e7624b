// caught by: choices, other-choices
// shown by: choices
// mistake: takes the first of several best actions.

// <solution chosenAction>
if (rng.uniform() < epsilon) return rng.index(static_cast<int>(worth.size()));
int best = 0;
worth.maxCoeff(&best);
return best;
// </solution>
