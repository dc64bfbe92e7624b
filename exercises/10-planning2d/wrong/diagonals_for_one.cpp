// caught by: grid-network, grid-any-map
// mistake: every step counts one, a diagonal one too.

// <solution cellNetwork>
for (std::size_t place = 0; place < network.size(); ++place) {
  const MapCell at = map.cellAt(place);
  for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y)
    for (int x = at.x - 1; x <= at.x + 1; ++x)
      if (map.isFree({x, y}) && map.isFree({x, at.y}) && map.isFree({at.x, y}) && MapCell{x, y} != at)
        network[place].push_back({map.placeOf({x, y}), 1});
}
// </solution>
