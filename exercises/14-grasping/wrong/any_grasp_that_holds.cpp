// caught by: any-places
// mistake: takes the first grasp with force closure.

// <solution bestGrasp>
Rng rng(7);
std::vector<PlanarFinger> grasp;
for (int draw = 0; draw < 10000; ++draw) {
  grasp.clear();
  for (int k = 0; k < count; ++k)
    grasp.push_back(fingerAlong(corners, rng.uniform(0, static_cast<double>(corners.size())), friction));
  if (epsilonOf(planarWrenches(grasp, center, length)) > 0) break;
}
return grasp;
// </solution>
