#pragma once

#include <cstdlib>
#include <string>
#include <vector>

#include "exercise.h"

// Maps and yards to try things on, for main() and for the checks.

/// A map from rows of '#' (blocked) and other signs (free), the highest first.
inline CellMap mapOf(const std::vector<std::string>& rows) {
  CellMap map{
      .width = static_cast<int>(rows.front().size()), .height = static_cast<int>(rows.size()), .blocked = {}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char sign : *row) map.blocked.push_back(sign == '#' ? 1 : 0);
  return map;
}

/// The straight line between two cells as cells beside one another: each step goes where the line is nearer.
inline std::vector<MapCell> straightCells(MapCell from, MapCell to) {
  std::vector<MapCell> line{from};
  const int width = std::abs(to.x - from.x), height = std::abs(to.y - from.y);
  for (int x = 0, y = 0; x < width || y < height;) {
    const bool isAcross = y == height || (x < width && (2 * x + 1) * height < (2 * y + 1) * width);
    (isAcross ? x : y) += 1;
    line.push_back({from.x + (to.x > from.x ? x : -x), from.y + (to.y > from.y ? y : -y)});
  }
  return line;
}

/// A map on which a bug runs in circles if it leaves its obstacle at any cell of the m-line, whichever hand
/// it uses.
inline CellMap hookMap() {
  return mapOf(
      {"..............................", "............##########........", "............#.................",
       "............#.................", "............#........#........", "............##########........",
       ".....................#........", ".....................#........", "........##############........",
       "........#.....................", "........#.....................", "........#.....................",
       "........#.....................", "..#######.....................", ".............................."});
}
inline constexpr MapCell kHookStart{1, 7}, kHookGoal{28, 8};

/// Rooms with doors.
inline CellMap roomMap() {
  return mapOf({"........#...............#.......", "........#...............#.......",
                "........#....######.....#.......", "..............#...#.............",
                "..............#...#.............", "........#.....#...#.....#.......",
                "####.####.....#...#.....####.###", "..........##......#.............",
                "...........##.....#.............", "............##....#.............",
                "............#######.............", "####.####...............###..###",
                "........#...............#.......", "........#....#######....#.......",
                "........#..........#............", "...................#............",
                "........#..........#....#.......", "........#..........#....#......."});
}
inline constexpr MapCell kRoomStart{2, 15}, kRoomGoal{30, 1};

/// A yard with a trap: a block with arms between the left side and the goal.
inline Yard trapYard() {
  return {{10, 6}, {{{5, 1.5}, {5.5, 4.5}}, {{4, 4}, {5, 4.5}}, {{4, 1.5}, {5, 2}}, {{7, 0}, {7.5, 1.5}}}};
}
inline const Eigen::Vector2d kTrapGoal(9, 3);

/// A wall with a slot of that width [m] that begins at a height of `low`, and blocks on both sides.
inline Yard slotYard(double low, double width) {
  return {{6, 4},
          {{{2, 0}, {4, low}},
           {{2, low + width}, {4, 4}},
           {{0.6, 0.6}, {1.2, 1.2}},
           {{0.5, 2.6}, {1.3, 3.1}},
           {{4.8, 2.3}, {5.4, 3.2}},
           {{4.9, 0.7}, {5.4, 1.3}}}};
}
inline const Eigen::Vector2d kSlotStart(0.3, 2), kSlotGoal(5.7, 2);
