#include "estimation/map_agreement.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

// Marks the cells for which `isMarked` holds somewhere within `reach`.
template <class IsMarked>
std::vector<bool> dilated(const OccupancyMap& map, int reach, const IsMarked& isMarked) {
  std::vector<bool> marks(static_cast<std::size_t>(map.width()) * static_cast<std::size_t>(map.height()));
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x) {
      if (!isMarked(x, y)) continue;
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, map.height() - 1); ++v)
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, map.width() - 1); ++u)
          marks[static_cast<std::size_t>(v) * static_cast<std::size_t>(map.width()) +
                static_cast<std::size_t>(u)] = true;
    }
  return marks;
}

}  // namespace

MapAgreement compareMaps(const OccupancyMap& map, const OccupancyMap& truth, int reach) {
  requireCount("reach of the comparison", reach, 0);
  if (map.width() != truth.width() || map.height() != truth.height())
    throw Error({.what = "maps to compare",
                 .found = fmt::format("{} x {} and {} x {} cells", map.width(), map.height(), truth.width(),
                                      truth.height()),
                 .wanted = "the same size"});
  const auto isOccupied = [&](int x, int y) { return map.isOccupied(x, y); };
  const auto isWall = [&](int x, int y) { return truth.isOccupied(x, y); };
  const std::vector<bool> nearWall = dilated(map, reach, isWall), nearHit = dilated(map, reach, isOccupied);
  int occupied = 0, right = 0, walls = 0, found = 0;
  for (int y = 0, cell = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x, ++cell) {
      const std::size_t i = static_cast<std::size_t>(cell);
      occupied += isOccupied(x, y);
      right += isOccupied(x, y) && nearWall[i];
      const bool isSeenWall = isWall(x, y) && map.logOdds(x, y) != 0;
      walls += isSeenWall;
      found += isSeenWall && nearHit[i];
    }
  MapAgreement result;
  if (right == 0 || found == 0) return result;
  result.precision = static_cast<double>(right) / occupied;
  result.recall = static_cast<double>(found) / walls;
  result.overlap = 2 * result.precision * result.recall / (result.precision + result.recall);
  return result;
}

}  // namespace rex
