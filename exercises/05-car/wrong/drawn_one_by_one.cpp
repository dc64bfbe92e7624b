// caught by: whole-parts, any-weights
// shown by: whole-parts
// mistake: each parent is drawn by itself, so that a heavy particle may end up without children.

// <solution resampledParents>
for (int k = 0; k < count; ++k) {
  double place = rng.uniform();
  int i = 0;
  while (i + 1 < weights.size() && place >= weights[i]) place -= weights[i++];
  parents.push_back(i);
}
// </solution>
