// caught by: unbiased, any-weights
// shown by: unbiased
// mistake: what remains after the whole parts goes to the first particles, instead of being drawn.

// <solution resampledParents>
for (int i = 0; i < weights.size(); ++i)
  parents.insert(parents.end(), static_cast<std::size_t>(weights[i] * count + 1e-9), i);
for (int i = 0; static_cast<int>(parents.size()) < count; ++i)
  if (weights[i] > 0) parents.push_back(i);
// </solution>
