#include "planning/bug.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

namespace rex {
namespace {

// Right, up, left, down: a quarter turn to the left is the next one.
constexpr std::array<GridCell, 4> kHeadings = {GridCell{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

GridCell ahead(GridCell cell, int heading) {
  const GridCell step = kHeadings[static_cast<std::size_t>(heading & 3)];
  return {cell.x + step.x, cell.y + step.y};
}

// The straight line as a chain of neighbouring cells: each step goes to the one closer to the line.
std::vector<GridCell> straightLine(GridCell from, GridCell to) {
  std::vector<GridCell> line{from};
  const long width = std::abs(to.x - from.x), height = std::abs(to.y - from.y);
  const int right = to.x > from.x ? 1 : -1, up = to.y > from.y ? 1 : -1;
  for (long x = 0, y = 0; x < width || y < height;) {
    const bool isAcross = y == height || (x < width && (2 * x + 1) * height < (2 * y + 1) * width);
    (isAcross ? x : y) += 1;
    line.push_back({from.x + right * static_cast<int>(x), from.y + up * static_cast<int>(y)});
  }
  return line;
}

int headingTo(GridCell from, GridCell to) {
  int heading = 0;
  while (ahead(from, heading) != to) ++heading;
  return heading;
}

// Follows an obstacle with the left hand on it.
class WallWalk {
 public:
  // The obstacle is ahead.
  WallWalk(const GridMap& map, GridCell cell, int heading) : map_(map), cell_(cell), heading_(heading) {
    turnToFree(heading - 1);
    first_ = {cell_, heading_};
  }

  GridCell cell() const { return cell_; }
  bool isEnclosed() const { return map_.isBlocked(ahead(cell_, heading_)); }

  void step() {
    cell_ = ahead(cell_, heading_);
    turnToFree(heading_ + 1);
  }
  // Back where it began, about to go the same way again.
  bool isRound() const { return cell_ == first_.cell && heading_ == first_.heading; }

 private:
  // The leftmost free heading, from the given one to the right.
  void turnToFree(int heading) {
    for (int i = 0; i < 4; ++i) {
      heading_ = (heading - i + 8) & 3;
      if (!map_.isBlocked(ahead(cell_, heading_))) return;
    }
  }

  struct Place {
    GridCell cell;
    int heading = 0;
  };
  const GridMap& map_;
  GridCell cell_;
  int heading_;
  Place first_{};
};

int distance(GridCell a, GridCell b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }

// The free heading that leads closer to the goal; of two, the one along the straight line. None if both are
// blocked.
std::optional<int> freeHeading(const GridMap& map, GridCell at, GridCell goal) {
  const int across = goal.x > at.x ? 0 : 2, along = goal.y > at.y ? 1 : 3;
  const bool isWide = std::abs(goal.x - at.x) >= std::abs(goal.y - at.y);
  for (const int heading : {isWide ? across : along, isWide ? along : across}) {
    const GridCell next = ahead(at, heading);
    if (distance(next, goal) < distance(at, goal) && !map.isBlocked(next)) return heading;
  }
  return std::nullopt;
}

// Follows a line from its cell i as far as it is free. Returns the index of the cell where it stops.
std::size_t follow(const GridMap& map, const std::vector<GridCell>& line, std::size_t i, BugWay& way) {
  while (i + 1 < line.size() && !map.isBlocked(line[i + 1])) way.cells.push_back(line[++i]);
  return i;
}

// Goes once around the obstacle, then the shorter way to the cell that was nearest to the goal.
GridCell goRound(WallWalk walk, GridCell goal, BugWay& way) {
  std::vector<GridCell> round{walk.cell()};
  std::size_t nearest = 0;
  do {
    walk.step();
    round.push_back(walk.cell());
    if (distance(walk.cell(), goal) < distance(round[nearest], goal)) nearest = round.size() - 1;
  } while (!walk.isRound());
  way.cells.insert(way.cells.end(), round.begin() + 1, round.end());
  const auto at = [&](std::size_t i) { return round.begin() + static_cast<std::ptrdiff_t>(i); };
  if (2 * nearest <= round.size())
    way.cells.insert(way.cells.end(), at(1), at(nearest) + 1);
  else
    for (std::size_t i = round.size() - 1; i > nearest; --i) way.cells.push_back(round[i - 1]);
  return round[nearest];
}

}  // namespace

BugWay bug1(const GridMap& map, GridCell start, GridCell goal) {
  map.requireFree("start", start);
  map.requireFree("goal", goal);
  BugWay way{.cells = {start}};
  for (GridCell at = start; at != goal;) {
    if (const std::optional<int> heading = freeHeading(map, at, goal)) {
      at = ahead(at, *heading);
      way.cells.push_back(at);
      continue;
    }
    const GridCell hit = at;
    way.hits.push_back(hit);
    const WallWalk walk(map, hit, headingTo(hit, straightLine(hit, goal)[1]));
    if (walk.isEnclosed()) return way;
    at = goRound(walk, goal, way);
    if (at == hit) return way;  // no cell is nearer: the obstacle encloses it, or the goal
    way.leaves.push_back(at);
  }
  way.status = BugStatus::kReached;
  return way;
}

BugWay bug2(const GridMap& map, GridCell start, GridCell goal) {
  map.requireFree("start", start);
  map.requireFree("goal", goal);
  BugWay way{.cells = {start}};
  const std::vector<GridCell> line = straightLine(start, goal);
  std::vector<std::size_t> placeOnLine(map.count(), 0);
  for (std::size_t i = 0; i < line.size(); ++i) placeOnLine[map.index(line[i])] = i;
  std::size_t at = 0;
  while ((at = follow(map, line, at, way)) + 1 < line.size()) {
    way.hits.push_back(line[at]);
    WallWalk walk(map, line[at], headingTo(line[at], line[at + 1]));
    if (walk.isEnclosed()) return way;
    std::size_t place = at;
    do {
      walk.step();
      way.cells.push_back(walk.cell());
      place = std::max(at, placeOnLine[map.index(walk.cell())]);
    } while (place == at && !walk.isRound());
    if (place == at) return way;
    at = place;
    way.leaves.push_back(line[at]);
  }
  way.status = BugStatus::kReached;
  return way;
}

}  // namespace rex
