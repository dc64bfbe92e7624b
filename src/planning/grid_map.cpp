#include "planning/grid_map.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/text.h"

namespace rex {
namespace {

constexpr std::size_t kMostCells = 100'000'000;

}  // namespace

GridMap::GridMap(int width, int height, double cellSize, const Eigen::Vector2d& origin)
    : width_(width), height_(height), cellSize_(cellSize), origin_(origin) {
  if (width < 1 || height < 1 ||
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > kMostCells) {
    throw Error({.what = "grid map",
                 .found = fmt::format("{} x {} cells", width, height),
                 .wanted = fmt::format("at least 1 x 1, at most {} in all", kMostCells)});
  }
  requirePositive("size of the cells of a grid map", cellSize, kMetres);
  requireFinite("origin of a grid map", origin);
  blocked_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

Eigen::Vector2d GridMap::center(GridCell cell) const {
  return origin_ + cellSize_ * Eigen::Vector2d(cell.x + .5, cell.y + .5);
}

GridCell GridMap::cellAt(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d cell = (point - origin_) / cellSize_;
  // Beyond the map any cell will do, but it must fit into an int.
  const auto place = [](double x, int size) {
    return static_cast<int>(std::floor(std::fmin(std::fmax(x, -1), size)));
  };
  return {place(cell.x(), width_), place(cell.y(), height_)};
}

void GridMap::requireFree(std::string_view what, GridCell cell) const {
  if (!isBlocked(cell)) return;
  throw Error(
      {.what = std::string(what),
       .found = fmt::format("cell ({}, {}), {}", cell.x, cell.y, contains(cell) ? "blocked" : "outside"),
       .wanted = fmt::format("a free cell of {} x {}", width_, height_)});
}

GridMap parseGridMap(std::string_view text, const std::string& name, double cellSize) {
  std::vector<std::string_view> rows = splitLines(withoutByteOrderMark(text));
  for (std::string_view& row : rows)
    if (row.ends_with('\r')) row.remove_suffix(1);
  while (!rows.empty() && rows.back().empty()) rows.pop_back();
  const auto refuse = [&](std::size_t row, std::size_t column, const std::string& found,
                          const std::string& wanted) {
    throw Error({.what = "grid map",
                 .where = {name, static_cast<int>(row + 1), static_cast<int>(column + 1)},
                 .found = found,
                 .wanted = wanted});
  };
  if (rows.empty()) refuse(0, 0, "no rows", "rows of '#' and '.'");
  GridMap map(std::max(1, static_cast<int>(rows[0].size())), static_cast<int>(rows.size()), cellSize);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t known = std::min(rows[row].find_first_not_of("#."), rows[row].size());
    if (known < rows[row].size())
      refuse(row, known, fmt::format("'{}'", rows[row].substr(known, 1)), "'#' for blocked or '.' for free");
    if (rows[row].size() != rows[0].size() || rows[row].empty())
      refuse(row, rows[row].size(), fmt::format("a row of {} cells", rows[row].size()),
             fmt::format("{}, as in the first row", std::max<std::size_t>(1, rows[0].size())));
    for (std::size_t x = 0; x < rows[row].size(); ++x)
      map.setBlocked({static_cast<int>(x), static_cast<int>(rows.size() - 1 - row)}, rows[row][x] == '#');
  }
  return map;
}

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
