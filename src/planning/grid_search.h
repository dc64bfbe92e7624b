#pragma once

#include <limits>
#include <vector>

#include "planning/grid_map.h"

namespace rex {

/// Which cells are neighbours: those beside one another; also those that share a corner, as on the slides; or
/// those only where both cells beside that corner are free, so that no way leads past the corner of an
/// obstacle.
enum class Connectivity { kFour, kEight, kEightWithRoom };

/// The numbers of the slides 4:18 to 4:24 for all cells (GridMap::index): 2 at the goal, one more with each
/// step, 1 where blocked, 0 where no way leads. Throws Error for a goal that is not free.
[[nodiscard]] std::vector<int> wavefront(const GridMap& map, GridCell goal, Connectivity connectivity);

/// Metres of the shortest way from one cell to all (GridMap::index), diagonal steps sqrt(2) cells long;
/// infinite where no way leads. Slide 4:26; Dijkstra 1959. Throws Error for a cell that is not free.
[[nodiscard]] std::vector<double> gridDistances(const GridMap& map, GridCell from, Connectivity connectivity);

/// A way from cell to cell.
struct GridPath {
  std::vector<GridCell> cells{};                            ///< from start to goal; empty: there is none
  double length = std::numeric_limits<double>::infinity();  ///< metres
  int expanded = 0;                                         ///< cells that were looked at on the search
};

/// The shortest way, by A* with the distance on an empty map as its estimate; Hart, Nilsson and Raphael 1968.
/// Throws Error for a start or goal that is not free.
[[nodiscard]] GridPath findGridPath(const GridMap& map, GridCell start, GridCell goal,
                                    Connectivity connectivity);

}  // namespace rex
