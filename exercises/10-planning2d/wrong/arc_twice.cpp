// caught by: grid-network
// mistake: one arc of each cell replaces its last one: the number of arcs is right, but one occurs twice.

// <solution cellNetwork>
for (std::size_t here = 0; here < network.size(); ++here) {
  const MapCell at = map.cellAt(here);
  for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y) {
    for (int x = at.x - 1; x <= at.x + 1; ++x) {
      const bool hasRoom = map.isFree({x, at.y}) && map.isFree({at.x, y});
      if (MapCell{x, y} == at || !map.isFree({x, y}) || !hasRoom) continue;
      network[here].push_back({map.placeOf({x, y}), x != at.x && y != at.y ? std::numbers::sqrt2 : 1});
    }
  }
  if (network[here].size() > 1) network[here].back() = network[here].front();
}
// </solution>
