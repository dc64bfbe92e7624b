// caught by: dubins-shortest, dubins-any
// shown by: dubins-shortest
// mistake: leaves out LRL and RLR.

// <solution shortestDubins>
double least = 1e300;
for (int w = 0; w < 4; ++w) {
  const auto word = static_cast<DubinsWord>(w);
  const auto lengths = dubinsLengths(word, from, to, radius);
  if (!lengths) continue;
  const double length = (*lengths)[0] + (*lengths)[1] + (*lengths)[2];
  if (length >= least) continue;
  least = length;
  best = {word, *lengths};
}
// </solution>
