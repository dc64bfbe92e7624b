// caught by: any-places
// mistake: takes for the inward normal of an edge the one towards the centre of the object.

// <solution bestGrasp>
const auto n = static_cast<double>(corners.size());
const auto fingersAt = [&](const std::vector<double>& places) {
  std::vector<PlanarFinger> grasp;
  for (const double place : places) {
    PlanarFinger one = fingerAlong(corners, place, friction);
    if (one.normal.dot(center - one.p) < 0) one.normal *= -1;
    grasp.push_back(one);
  }
  return grasp;
};
Rng rng(7);
std::vector<double> best(static_cast<std::size_t>(count), 0.5), other = best;
double quality = -1;
for (int trial = 0; trial < 4000; ++trial) {
  for (std::size_t k = 0; k < other.size(); ++k)
    other[k] = trial % 2 == 0 ? rng.uniform(0, n) : best[k] + 0.1 * rng.normal();
  const double then = epsilonOf(planarWrenches(fingersAt(other), center, length));
  if (then > quality) best = other;
  quality = std::max(quality, then);
}
return fingersAt(best);
// </solution>
