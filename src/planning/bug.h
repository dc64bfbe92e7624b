#pragma once

#include "planning/grid_map.h"

namespace rex {

enum class BugStatus {
  kReached,
  kUnreachable  ///< it circled an obstacle without finding a point to leave it
};

/// The path of a robot that knows its goal and senses only the adjacent cells.
struct BugWay {
  BugStatus status = BugStatus::kUnreachable;
  std::vector<GridCell> cells{};           ///< each adjacent to the one before
  std::vector<GridCell> hits{}, leaves{};  ///< where it met obstacles, and where it left them for the goal
};

/// Bug 1: heads for the goal. When it hits an obstacle it circles it once, returns to the cell nearest to
/// the goal, and continues from there. It finds every goal that horizontal and vertical steps can reach,
/// and otherwise reports kUnreachable. Slides 4:7 to 4:11; Lumelsky and Stepanov 1987. Throws Error for a
/// start or goal that is not free.
[[nodiscard]] BugWay bug1(const GridMap& map, GridCell start, GridCell goal);

/// Bug 2: follows the straight line from start to goal. When it hits an obstacle it turns right and goes
/// around it until it meets the line nearer to the goal. Slides 4:8 to 4:11. The same guarantee and
/// exceptions as bug1().
[[nodiscard]] BugWay bug2(const GridMap& map, GridCell start, GridCell goal);

}  // namespace rex
