// caught by: choices, other-choices
// shown by: choices
// mistake: a random action is never the best one.

// <solution chosenAction>
const auto m = static_cast<int>(worth.size());
std::vector<int> best, others;
for (int a = 0; a < m; ++a) (worth[a] == worth.maxCoeff() ? best : others).push_back(a);
const std::vector<int>& from = !others.empty() && rng.uniform() < epsilon ? others : best;
return from[static_cast<std::size_t>(rng.index(static_cast<int>(from.size())))];
// </solution>
