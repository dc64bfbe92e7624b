// caught by: any-places
// mistake: takes the first grasp with force closure.

// <solution bestGrasp>
const std::vector<PlanarFinger> places = placesOn(corners, friction, 12);
Rng rng(7);
std::vector<PlanarFinger> grasp;
for (int draw = 0; draw < 10000; ++draw) {
  grasp.clear();
  for (int k = 0; k < count; ++k) grasp.push_back(places[rng.index(static_cast<int>(places.size()))]);
  if (epsilonOf(planarWrenches(grasp, center, length)) > 0) break;
}
return grasp;
// </solution>
