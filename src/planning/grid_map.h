#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace rex {

/// A cell by column and row, from the lower left.
struct GridCell {
  int x = 0, y = 0;
  bool operator==(const GridCell&) const = default;
};

/// A rectangle of square cells, each free or blocked. Cell (0, 0) has its lower left corner at the origin.
class GridMap {
 public:
  /// All free. Throws Error for sizes that are not positive, an origin that is not finite, and more than 100
  /// million cells.
  GridMap(int width, int height, double cellSize = 1,
          const Eigen::Vector2d& origin = Eigen::Vector2d::Zero());

  int width() const { return width_; }
  int height() const { return height_; }
  double cellSize() const { return cellSize_; }
  bool contains(GridCell cell) const {
    return 0 <= cell.x && cell.x < width_ && 0 <= cell.y && cell.y < height_;
  }
  /// Cells outside the map are blocked.
  bool isBlocked(GridCell cell) const { return !contains(cell) || blocked_[index(cell)] != 0; }
  /// The cell must be inside.
  void setBlocked(GridCell cell, bool blocked = true) { blocked_[index(cell)] = blocked ? 1 : 0; }
  /// Index of a cell in lists of all cells: row by row, from the lowest.
  std::size_t index(GridCell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(cell.x);
  }
  std::size_t count() const { return blocked_.size(); }

  /// The centre of a cell, metres.
  [[nodiscard]] Eigen::Vector2d center(GridCell cell) const;
  [[nodiscard]] GridCell cellAt(const Eigen::Vector2d& point) const;

  /// Throws Error if the cell is outside or blocked; `what` names it.
  void requireFree(std::string_view what, GridCell cell) const;

 private:
  int width_, height_;
  double cellSize_;
  Eigen::Vector2d origin_;
  std::vector<std::uint8_t> blocked_;
};

/// Reads a map of '#' (blocked) and '.' (free), one row per line, top row first. Throws Error with
/// file:line:column for other characters, rows of different lengths, and a map without cells.
[[nodiscard]] GridMap parseGridMap(std::string_view text, const std::string& name, double cellSize = 1);

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
