// caught by: smooth-free, smooth-disc
// shown by: smooth-free
// mistake: moves each node to the middle of its neighbours, again and again, and never tests an edge.

// <solution shortened>
for (int round = 0; round < 200; ++round)
  for (std::size_t i = 1; i + 1 < better.size(); ++i) better[i] = (better[i - 1] + better[i + 1]) / 2;
// </solution>
