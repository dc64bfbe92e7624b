#include "planning/grid_search.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

namespace rex {
namespace {

constexpr double kDiagonal = std::numbers::sqrt2;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Calls visit(cell, length) for all free neighbours, the length in cells.
template <class Visit>
void forEachNeighbor(const GridMap& map, GridCell at, Connectivity connectivity, const Visit& visit) {
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const GridCell cell{at.x + dx, at.y + dy};
      if ((dx == 0 && dy == 0) || map.isBlocked(cell)) continue;
      const bool isDiagonal = dx != 0 && dy != 0;
      if (isDiagonal) {
        if (connectivity == Connectivity::kFour) continue;
        const bool hasRoom = !map.isBlocked({cell.x, at.y}) && !map.isBlocked({at.x, cell.y});
        if (connectivity == Connectivity::kEightWithRoom && !hasRoom) continue;
      }
      visit(cell, isDiagonal ? kDiagonal : 1.);
    }
  }
}

GridCell cellOf(const GridMap& map, std::size_t index) {
  const auto width = static_cast<std::size_t>(map.width());
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

// Best-first search: the costs of the cells reached, and the cell that each was reached from. Stops at the
// goal, if there is one.
struct GridSearch {
  std::vector<double> cost;
  std::vector<std::size_t> from;
  int expanded = 0;
};

template <class Estimate>
GridSearch searchFrom(const GridMap& map, GridCell start, const GridCell* goal, Connectivity connectivity,
                      const Estimate& estimate) {
  GridSearch search{std::vector<double>(map.count(), kInfinite),
                    std::vector<std::size_t>(map.count(), map.count())};
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  std::vector<bool> isDone(map.count());
  search.cost[map.index(start)] = 0;
  open.emplace(estimate(start), map.index(start));
  while (!open.empty()) {
    const std::size_t at = open.top().second;
    open.pop();
    if (isDone[at]) continue;
    isDone[at] = true;
    ++search.expanded;
    const GridCell cell = cellOf(map, at);
    if (goal != nullptr && cell == *goal) break;
    forEachNeighbor(map, cell, connectivity, [&](GridCell next, double length) {
      const std::size_t i = map.index(next);
      const double cost = search.cost[at] + length;
      if (cost >= search.cost[i]) return;
      search.cost[i] = cost;
      search.from[i] = at;
      open.emplace(cost + estimate(next), i);
    });
  }
  return search;
}

}  // namespace

std::vector<int> wavefront(const GridMap& map, GridCell goal, Connectivity connectivity) {
  map.requireFree("goal", goal);
  std::vector<int> numbers(map.count());
  for (std::size_t i = 0; i < map.count(); ++i) numbers[i] = map.isBlocked(cellOf(map, i)) ? 1 : 0;
  std::vector<GridCell> front{goal}, next;
  numbers[map.index(goal)] = 2;
  for (int number = 3; !front.empty(); ++number) {
    for (const GridCell cell : front) {
      forEachNeighbor(map, cell, connectivity, [&](GridCell neighbor, double) {
        int& reached = numbers[map.index(neighbor)];
        if (reached != 0) return;
        reached = number;
        next.push_back(neighbor);
      });
    }
    front.swap(next);
    next.clear();
  }
  return numbers;
}

std::vector<double> gridDistances(const GridMap& map, GridCell from, Connectivity connectivity) {
  map.requireFree("start", from);
  GridSearch search = searchFrom(map, from, nullptr, connectivity, [](GridCell) { return 0.; });
  for (double& cost : search.cost) cost *= map.cellSize();
  return std::move(search.cost);
}

GridPath findGridPath(const GridMap& map, GridCell start, GridCell goal, Connectivity connectivity) {
  map.requireFree("start", start);
  map.requireFree("goal", goal);
  const auto estimate = [&](GridCell cell) {
    const int dx = std::abs(cell.x - goal.x), dy = std::abs(cell.y - goal.y);
    if (connectivity == Connectivity::kFour) return static_cast<double>(dx + dy);
    return std::max(dx, dy) + (kDiagonal - 1) * std::min(dx, dy);
  };
  const GridSearch search = searchFrom(map, start, &goal, connectivity, estimate);
  GridPath path{.expanded = search.expanded};
  if (search.cost[map.index(goal)] == kInfinite) return path;
  path.length = search.cost[map.index(goal)] * map.cellSize();
  for (std::size_t at = map.index(goal); at < map.count(); at = search.from[at])
    path.cells.push_back(cellOf(map, at));
  std::reverse(path.cells.begin(), path.cells.end());
  return path;
}

}  // namespace rex
