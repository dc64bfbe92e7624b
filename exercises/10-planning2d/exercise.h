#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. Metres, in the plane. Slides are named as chapter:number.

// Maps of cells, for parts 1, 2 and 5.

/// A square of one metre by its column and row, from the lower left.
struct MapCell {
  int x = 0, y = 0;
  bool operator==(const MapCell&) const = default;
};

/// A rectangle of cells. Lists of all cells go row by row, from the lowest.
struct CellMap {
  int width = 0, height = 0;
  std::vector<int> blocked;  ///< 1 or 0 for each cell

  std::size_t placeOf(MapCell cell) const { return static_cast<std::size_t>(cell.y * width + cell.x); }
  MapCell cellAt(std::size_t place) const {
    return {static_cast<int>(place) % width, static_cast<int>(place) / width};
  }
  /// No cell outside the map is free.
  bool isFree(MapCell cell) const {
    return 0 <= cell.x && cell.x < width && 0 <= cell.y && cell.y < height && blocked[placeOf(cell)] == 0;
  }
};

/// Nodes 0, 1, ... and, for each, where its arcs lead and how long they are. Every arc has one of the same
/// length that leads back.
struct Arc {
  std::size_t to = 0;
  double length = 0;
};
using Network = std::vector<std::vector<Arc>>;

// Part 1, a bug (4:7 to 4:11).

/// The cells of a bug's path from its start, each beside the one before, and whether it reached its goal.
struct BugTrail {
  bool reached = false;
  std::vector<MapCell> cells;
};

/// Bug 2 (4:11). The m-line leads from the start (its first cell) to the goal (its last), each cell beside
/// the one before; both ends are free. isFree(cell) may be asked only about the eight cells around a cell
/// that the bug visits; it moves up, down, left and right. In each cell off the m-line it touches an
/// obstacle (corner to corner counts). It takes at most the steps of the m-line and, for each time that the
/// m-line enters an obstacle, one circuit around it: four steps, plus one for each side of a cell that the
/// obstacle shares with free cells. (The outside of the map is an obstacle, too.) It reaches the goal, or
/// says that no path leads there. To do so, Bug 2 always turns to the same side, returns to the m-line only
/// at cells that are nearer to the goal, and gives up when it is back where it met the obstacle and would
/// make the same step again.
BugTrail bugTwo(const std::vector<MapCell>& mLine, const std::function<bool(MapCell)>& isFree);

// Part 2, wavefront and Dijkstra (4:18 to 4:26).

/// The numbers of slides 4:18 to 4:25 for all cells: 2 at the goal, which is free; one more with each step
/// to one of the eight neighbours; 1 at blocked cells; 0 at cells that cannot be reached.
std::vector<int> waveNumbers(const CellMap& map, MapCell goal);

/// All cells as nodes, in the order of lists. Arcs join free cells: sides 1 m, diagonals sqrt(2) m. A
/// diagonal arc exists only if both cells beside it are free, so that nothing scrapes along a corner.
Network cellNetwork(const CellMap& map);

/// The length of the shortest path from one node to every node, itself included; infinite where there is none
/// (4:26). All arcs have a positive length.
std::vector<double> dijkstra(const Network& network, std::size_t from);

/// A shortest path from `start` to the node where `distances` (from dijkstra()) is zero, both included.
/// Empty if there is none.
std::vector<std::size_t> wayDown(const Network& network, const std::vector<double>& distances,
                                 std::size_t start);

// A yard with blocks in it, for parts 3 and 4.

struct Block {
  Eigen::Vector2d lower = Eigen::Vector2d::Zero(), upper = Eigen::Vector2d::Zero();  ///< its corners
};
/// The rectangle from (0, 0) to `size`. Blocks may overlap.
struct Yard {
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  std::vector<Block> blocks;
};

/// The point of a block that is nearest to p; p itself if that is inside.
inline Eigen::Vector2d nearestPoint(const Block& block, const Eigen::Vector2d& p) {
  return {std::clamp(p.x(), block.lower.x(), block.upper.x()),
          std::clamp(p.y(), block.lower.y(), block.upper.y())};
}

/// Whether p is in the yard and in no block.
inline bool isFree(const Yard& yard, const Eigen::Vector2d& p) {
  if (nearestPoint({Eigen::Vector2d::Zero(), yard.size}, p) != p) return false;
  for (const Block& block : yard.blocks)
    if (nearestPoint(block, p) == p) return false;
  return true;
}

// Part 3, potential fields (4:13 to 4:17).

struct FieldGains {
  double attraction = 1;  ///< k
  double repulsion = 1;   ///< eta
  double reach = 1;       ///< rho [m]
};

/// U = k |p - goal|^2 / 2 + the sum over all blocks at a distance d < rho of eta (1/d - 1/rho)^2 / 2.
/// Infinite in blocks. The border of the yard does not push.
double fieldPotential(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                      const Eigen::Vector2d& p);

/// Its derivative with respect to p, outside of blocks, as a column.
Eigen::Vector2d fieldGradient(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                              const Eigen::Vector2d& p);

/// The points of a descent, and how it ended.
enum class Ending { kAtGoal, kStuck };
struct FieldTrail {
  Ending ending = Ending::kStuck;
  std::vector<Eigen::Vector2d> points;
};

/// Descends the potential from `start` (outside of blocks) in steps of at most `stepSize` metres; each
/// point is lower than the one before. It ends within stepSize of the goal, or stuck elsewhere, where the
/// gradient is shorter than k times 0.01 m: slide 4:16.
FieldTrail slideDown(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                     const Eigen::Vector2d& start, double stepSize);

// Part 4, probabilistic roadmaps (4:28 to 4:36).

/// The local planner of slide 4:32: whether the points of the straight line from a to b, both included and no
/// more than `resolution` metres apart, are free.
bool straightIsFree(const Yard& yard, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double resolution);

/// Each makes one attempt to find a free node, with random numbers of rng, and returns nothing if it fails.
/// Slides 4:31 (line 3 and 4) and 4:35. N(q1, sigma) adds a normal number of standard deviation sigma [m] to
/// each coordinate; q2 may leave the yard, where nothing is free.
std::optional<Eigen::Vector2d> uniformSample(const Yard& yard, rex::Rng& rng);
std::optional<Eigen::Vector2d> gaussianSample(const Yard& yard, double sigma, rex::Rng& rng);
std::optional<Eigen::Vector2d> bridgeSample(const Yard& yard, double sigma, rex::Rng& rng);

/// Lines 6 to 11 of slide 4:31, for more than k nodes, all different: arcs there and back between each node
/// q and those of the k other nodes nearest to it to which the straight line is free. No arc occurs twice.
Network joinNearest(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes, int k, double resolution);

/// The shortest path from start over the roadmap to goal, both included. Each of these two is joined to
/// those of the k nodes nearest to it to which the straight line is free. Empty if there is no path.
std::vector<Eigen::Vector2d> queryRoadmap(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes,
                                          const Network& roadmap, const Eigen::Vector2d& start,
                                          const Eigen::Vector2d& goal, int k, double resolution);

// Part 5, A*: Dijkstra that knows where the goal is.

/// The length of the shortest path in a cellNetwork() of an endless map without obstacles.
double emptyMapDistance(MapCell from, MapCell to);

/// A shortest path from start to goal, both included; empty if there is none. `estimates` has a number for
/// each node, which is at most the length of the path from there to the goal and changes along an arc by at
/// most the arc's length. arcsOf(node) returns the arcs of a node. It is expensive: call it at most once
/// for each node, and only if the length of the path from the start to the node plus its estimate is at most
/// the length of the path you return.
std::vector<std::size_t> aStar(const std::function<std::vector<Arc>(std::size_t)>& arcsOf, std::size_t start,
                               std::size_t goal, const std::vector<double>& estimates);
