#pragma once

#include <limits>

#include "planning/control_tree.h"
#include "systems/car.h"

namespace rex {

struct HybridAStarOptions {
  double cellSize = 0.1;       ///< metres; an arc is 1.5 cells long
  int headings = 144;          ///< cells of a whole turn
  int steeringAngles = 3;      ///< that are tried, evenly spaced: an odd number
  double reverseFactor = 1.5;  ///< cost of a metre backward, at least 1; a metre forward costs 1
  double switchCost = 1;       ///< of changing between forward and backward
  double steeringCost = 0.2;   ///< of turning the front wheels by a radian
  /// Reeds-Shepp curves to the end of the search are tried from states nearer to it than this, metres.
  double analyticReach = std::numeric_limits<double>::infinity();
  /// The search ends when the cost is at most this share above the least on the grid.
  double slack = 0.1;
  /// Search from the goal, where a car that parks has less room, or from the start.
  bool fromGoal = true;
  int maxExpanded = 500'000;
};

/// A path of a car with its cost.
struct CarPath {
  /// At 1 m/s. found.trees[0] is what was explored, from the goal with fromGoal, and edges lead to its nodes.
  ControlPath driven{};
  double cost = std::numeric_limits<double>::infinity();
  double leastCost = 0;      ///< no path on the grid costs less
  double length = 0;         ///< metres driven
  int switches = 0;          ///< changes of direction
  int expanded = 0;          ///< states
  bool isExhausted = false;  ///< there is no path on this grid: all states that can be reached were expanded
};

/// Hybrid A*: arcs lead between continuous states, and one state is kept in each cell of a grid over x,
/// y, heading and direction. The heuristic is the larger of the Reeds-Shepp length, which ignores obstacles,
/// and the length of a path on the grid over x and y, which ignores that the car must turn; Reeds-Shepp
/// curves that hit nothing end the search. Dolgov, Thrun, Montemerlo and Diebel, Path planning for autonomous
/// vehicles in unknown semi-structured environments, 2010. The space of the problem is that of
/// Space::se2(); motions are checked at points no farther apart than its resolution. Throws Error like
/// requireSound, for a space of another kind, and options out of range.
[[nodiscard]] CarPath findCarPath(const Car& car, const PathProblem& problem,
                                  const HybridAStarOptions& options = {});

}  // namespace rex
