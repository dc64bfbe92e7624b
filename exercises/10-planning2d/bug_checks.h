#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "grid_checks.h"
#include "planning/bug.h"

// The checks of part 1.

// The number of sides that an obstacle shares with free cells, stored at each of its cells. Obstacles that
// touch at a corner are one, and all that touch the border are one with it. A frame is added around the
// map.
class Obstacles {
 public:
  explicit Obstacles(const CellMap& map) : map_(map) {
    const auto cells = static_cast<std::size_t>((map.width + 2) * (map.height + 2));
    obstacleOf_.assign(cells, -1);
    for (int y = -1; y <= map.height; ++y)
      for (int x = -1; x <= map.width; ++x)
        if (!map.isFree({x, y}) && obstacleAt({x, y}) < 0) collect({x, y});
  }

  int sidesAt(MapCell cell) const { return sides_[static_cast<std::size_t>(obstacleOf_[placeOf(cell)])]; }

 private:
  bool isInFrame(MapCell cell) const {
    return -1 <= cell.x && cell.x <= map_.width && -1 <= cell.y && cell.y <= map_.height;
  }
  std::size_t placeOf(MapCell cell) const {
    return static_cast<std::size_t>((cell.y + 1) * (map_.width + 2) + cell.x + 1);
  }
  int obstacleAt(MapCell cell) const { return obstacleOf_[placeOf(cell)]; }

  void collect(MapCell first) {
    int sides = 0;
    std::vector<MapCell> open{first};
    obstacleOf_[placeOf(first)] = static_cast<int>(sides_.size());
    while (!open.empty()) {
      const MapCell at = open.back();
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const MapCell next{at.x + dx, at.y + dy};
          if (map_.isFree(next)) sides += dx == 0 || dy == 0 ? 1 : 0;
          if (!isInFrame(next) || map_.isFree(next) || obstacleAt(next) >= 0) continue;
          obstacleOf_[placeOf(next)] = static_cast<int>(sides_.size());
          open.push_back(next);
        }
    }
    sides_.push_back(sides);
  }

  const CellMap& map_;
  std::vector<int> obstacleOf_, sides_;
};

// Lumelsky and Stepanov's bound, in cells: the m-line and, for each time that it enters an obstacle, one
// circuit around that. Half the crossings with the border of an obstacle enter it: this is D + sum n p / 2.
// A circuit along p sides of cells takes p + 4 steps: two at a convex corner, none at a concave one, and
// there are four more convex ones.
inline double bugBound(const CellMap& map, const std::vector<MapCell>& line) {
  const Obstacles obstacles(map);
  double bound = static_cast<double>(line.size()) - 1;
  for (std::size_t i = 1; i < line.size(); ++i)
    if (map.isFree(line[i - 1]) && !map.isFree(line[i])) bound += obstacles.sidesAt(line[i]) + 4;
  return bound;
}

inline bool touchesObstacle(const CellMap& map, MapCell cell) {
  for (int y = cell.y - 1; y <= cell.y + 1; ++y)
    for (int x = cell.x - 1; x <= cell.x + 1; ++x)
      if (!map.isFree({x, y})) return true;
  return false;
}

// The way of a bug beside that of the library's bug, up to where it went wrong if that is known.
inline rex::grading::Evidence bugSeen(const CellMap& map, const std::vector<MapCell>& line,
                                      const std::vector<MapCell>& trail, const std::vector<MapCell>& asked) {
  rex::Figure figure = planOf("The trail of bugTwo", map);
  std::vector<MapCell> wanted;
  for (const rex::GridCell cell :
       rex::bug2(gridMapOf(map), {line.front().x, line.front().y}, {line.back().x, line.back().y}).cells)
    wanted.push_back({cell.x, cell.y});
  addLine(figure, centersOf(line), {.label = "m-line", .size = 1, .color = kGray});
  if (trail.empty()) addLine(figure, centersOf(asked), dots("cells asked for", kGray, .8));
  addLine(figure, centersOf(trail), rex::grading::gotCurve("got"));
  addLine(figure, centersOf(wanted), rex::grading::wantedCurve("wanted, or as long"));
  addEnds(figure, centerOf(line.front()), centerOf(line.back()));
  const auto ring = [&](const std::string& label, MapCell cell) {
    figure.series.push_back(rex::grading::wrongPoint(label, centerOf(cell).x(), centerOf(cell).y()));
  };
  for (std::size_t i = 0; i < trail.size(); ++i) {
    const bool isOnLine = std::find(line.begin(), line.end(), trail[i]) != line.end();
    const bool isWrong = !map.isFree(trail[i]) || (i > 0 && !isBeside(trail[i], trail[i - 1])) ||
                         (!isOnLine && !touchesObstacle(map, trail[i]));
    if (!isWrong) continue;
    ring("blocked, a leap, or astray", trail[i]);
    return {.figures = {figure}};
  }
  if (!trail.empty() && !(trail.back() == line.back())) ring("ends here", trail.back());
  return {.figures = {figure}};
}

// Each cell of the trail is free, beside the one before, and on the m-line or along an obstacle.
inline void trailIsSound(rex::grading::Check& check, const CellMap& map, const std::vector<MapCell>& line,
                         const std::vector<MapCell>& cells) {
  check.that("the trail of bugTwo begins at the start", !cells.empty() && cells.front() == line.front());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string where = fmt::format("at cell {} of the trail, {}", i, nameOf(cells[i]));
    holdsWhere(check, "each cell in the trail of bugTwo is free", map.isFree(cells[i]), where);
    if (i > 0)
      holdsWhere(check, "each cell in the trail of bugTwo is beside the one before",
                 isBeside(cells[i], cells[i - 1]), where + " after " + nameOf(cells[i - 1]));
    holdsWhere(check, "bugTwo leaves the m-line only along obstacles",
               std::find(line.begin(), line.end(), cells[i]) != line.end() || touchesObstacle(map, cells[i]),
               where);
  }
}

// A bug that runs in circles is stopped by the limit on its questions: a correct one needs at most four
// answers per step, and gets forty.
inline void bugObeys(rex::grading::Check& check, Student& student, const CellMap& map, MapCell start,
                     MapCell goal) {
  const std::vector<MapCell> line = straightCells(start, goal);
  const double bound = bugBound(map, line);
  std::vector<MapCell> asked;
  BugTrail trail;
  const auto shown = check.show([&] { return bugSeen(map, line, trail.cells, asked); });
  trail = student.bugTwo(line, [&](MapCell cell) {
    holdsWhere(check, "bugTwo asks isFree only about cells that touch its trail",
               -1 <= cell.x && cell.x <= map.width && -1 <= cell.y && cell.y <= map.height,
               "about " + nameOf(cell));
    asked.push_back(cell);
    const auto circles = check.ask(
        "Does the bug run in circles? It returns to the m-line only nearer to the goal than where it met the "
        "obstacle.");
    check.atMost("number of calls of isFree by bugTwo", static_cast<double>(asked.size()), 40 * (bound + 10));
    return map.isFree(cell);
  });
  const std::vector<MapCell>& cells = trail.cells;
  trailIsSound(check, map, line, cells);
  const bool isReachable =
      std::isfinite(distancesOn(map, start, rex::Connectivity::kFour)[map.placeOf(goal)]);
  const bool isBack = std::count(cells.begin(), cells.end(), cells.back()) == 2;
  const auto early = check.ask(
      "Is passing the cell where it met the obstacle taken for a full circuit? The bug is round when it "
      "would "
      "make the same step again.",
      isReachable && !trail.reached && isBack);
  const std::string end = "the trail ends at " + nameOf(cells.back()) + (trail.reached ? ", reached" : "");
  holdsWhere(check,
             isReachable ? "bugTwo reaches the goal, since a way leads there"
                         : "bugTwo says that it has not reached the goal, since no way leads there",
             trail.reached == isReachable && (!isReachable || cells.back() == goal), end);
  check.atMost("number of steps of bugTwo", static_cast<double>(cells.size()) - 1, bound);
  for (const MapCell cell : asked)
    holdsWhere(check, "bugTwo asks isFree only about cells that touch its trail",
               std::any_of(cells.begin(), cells.end(), [&](MapCell at) { return touches(at, cell); }),
               "about " + nameOf(cell));
}
