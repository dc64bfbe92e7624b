#pragma once

#include "planning/grid_search.h"

namespace rex {

enum class BugStatus {
  kReached,
  kUnreachable  ///< it came round an obstacle without a place to leave it
};

/// Where a robot went that knows its goal and feels only the cells beside it.
struct BugWay {
  BugStatus status = BugStatus::kUnreachable;
  std::vector<GridCell> cells{};           ///< each beside the one before
  std::vector<GridCell> hits{}, leaves{};  ///< where it met obstacles, and where it left them for the goal
};

/// Bug 1: heads for the goal; where something is in the way it goes once around, back to the place that was
/// nearest to the goal, and on from there. It finds every goal that can be reached by steps to the side and
/// up and down, or says that there is no way. Slides 4:7 to 4:11; Lumelsky and Stepanov 1987. Throws Error
/// for a start or goal that is not free.
[[nodiscard]] BugWay bug1(const GridMap& map, GridCell start, GridCell goal);

/// Bug 2: follows the straight line from start to goal; where something is in the way it goes around, to its
/// right, until it meets the line nearer to the goal. Slides 4:8 to 4:11. Finds and throws as bug1().
[[nodiscard]] BugWay bug2(const GridMap& map, GridCell start, GridCell goal);

}  // namespace rex
