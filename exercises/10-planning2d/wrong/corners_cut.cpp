// caught by: grid-network, grid-any-map
// shown by: grid-network
// mistake: diagonal arcs cut corners, as on the slides of the wavefront.

// <solution cellNetwork>
for (std::size_t place = 0; place < network.size(); ++place) {
  const MapCell at = map.cellAt(place);
  for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y)
    for (int x = at.x - 1; x <= at.x + 1; ++x)
      if (map.isFree({x, y}) && MapCell{x, y} != at)
        network[place].push_back({map.placeOf({x, y}), x != at.x && y != at.y ? std::numbers::sqrt2 : 1});
}
// </solution>
