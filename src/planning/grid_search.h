#pragma once

#include <limits>
#include <vector>

#include "planning/grid_map.h"

namespace rex {

/// Which cells are neighbours: those that share a side; also those that share a corner, as on the slides;
/// or the latter only if both other cells at that corner are free, so that no path cuts the corner of an
/// obstacle.
enum class Connectivity { kFour, kEight, kEightWithRoom };

/// The wavefront numbers of slides 4:18 to 4:24 for all cells (GridMap::index): 2 at the goal, one more
/// with each step, 1 for blocked and 0 for unreachable cells. Throws Error for a goal that is not free.
[[nodiscard]] std::vector<int> wavefront(const GridMap& map, GridCell goal, Connectivity connectivity);

/// Lengths in metres of the shortest paths from one cell to all (GridMap::index), with diagonal steps
/// sqrt(2) cells long; infinite for unreachable cells. Slide 4:26; Dijkstra 1959. Throws Error for a cell
/// that is not free.
[[nodiscard]] std::vector<double> gridDistances(const GridMap& map, GridCell from, Connectivity connectivity);

/// A path from cell to cell.
struct GridPath {
  std::vector<GridCell> cells{};                            ///< from start to goal; empty: there is none
  double length = std::numeric_limits<double>::infinity();  ///< metres
  int expanded = 0;                                         ///< cells expanded by the search
};

/// The shortest path, by A* with the distance on an empty map as heuristic; Hart, Nilsson and Raphael 1968.
/// Throws Error for a start or goal that is not free.
[[nodiscard]] GridPath findGridPath(const GridMap& map, GridCell start, GridCell goal,
                                    Connectivity connectivity);

}  // namespace rex
