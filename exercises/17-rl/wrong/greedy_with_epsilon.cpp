// caught by: choices, other-choices
// shown by: choices
// mistake: takes the best action with probability epsilon.

// <solution chosenAction>
const auto m = static_cast<int>(worth.size());
if (rng.uniform() >= epsilon) return rng.index(m);
std::vector<int> best;
for (int a = 0; a < m; ++a)
  if (worth[a] == worth.maxCoeff()) best.push_back(a);
return best[static_cast<std::size_t>(rng.index(static_cast<int>(best.size())))];
// </solution>
