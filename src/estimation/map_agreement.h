#pragma once

#include "estimation/occupancy_map.h"

namespace rex {

/// How well the walls of two maps with the same cells agree.
struct MapAgreement {
  double precision = 0;  ///< share of the occupied cells that lie within `reach` of one of the truth
  double recall = 0;     ///< share of the cells of the truth, of those that were observed, that have one
  double overlap = 0;    ///< harmonic mean of both, zero if a map has no occupied cells
};
/// Compares occupied cells up to a distance of `reach` cells along each axis. A cell counts as observed if
/// the map knows anything about it. Throws Error for maps of different size and a negative reach.
[[nodiscard]] MapAgreement compareMaps(const OccupancyMap& map, const OccupancyMap& truth, int reach = 1);

}  // namespace rex
