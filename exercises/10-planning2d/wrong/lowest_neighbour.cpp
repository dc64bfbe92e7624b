// caught by: grid-way
// shown by: grid-way
// mistake: goes to the lowest neighbour, as slide 4:25 says; if arcs differ in length, that is a detour.

// <solution wayDown>
if (distances[start] == kInfinite) return {};
std::vector<std::size_t> way = {start};
while (distances[way.back()] > 0) {
  const std::vector<Arc>& arcs = network[way.back()];
  const auto best = std::min_element(arcs.begin(), arcs.end(), [&](const Arc& a, const Arc& b) {
    return distances[a.to] < distances[b.to];
  });
  way.push_back(best->to);
}
return way;
// </solution>
