#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <queue>
#include <string>
#include <utility>

#include "drawing.h"
#include "exercise.h"
#include "maps.h"
#include "planning/bug.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Right, up, left, down: plus one is a quarter turn to the left, whatever the sign of the heading.
Cell ahead(Cell cell, int heading) {
  const std::array<Cell, 4> steps = {Cell{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const Cell step = steps[static_cast<std::size_t>(heading & 3)];
  return {cell.x + step.x, cell.y + step.y};
}

BugTrail bugTwo(const std::vector<Cell>& mLine, const std::function<bool(Cell)>& isFree) {
  BugTrail trail{.reached = false, .cells = {mLine.front()}};
  // TODO: along the line while it is free; else around the obstacle, until the line is met nearer to the
  // goal. Which heading comes first if one hand stays on the wall? How does the bug know it is round?
  notUsedYet(isFree);
  return trail;
}

std::vector<int> waveNumbers(const CellMap& map, Cell goal) {
  std::vector<int> numbers = map.blocked;
  // TODO: begin with 2 at the goal. Each cell of the front gives its number plus one to what is still 0.
  notUsedYet(goal);
  return numbers;
}

Network cellNetwork(const CellMap& map) {
  Network network(map.blocked.size());
  // TODO: arcs of each free cell to the free ones around it. Which diagonals are left out?
  return network;
}

std::vector<double> dijkstra(const Network& network, std::size_t from) {
  std::vector<double> distances(network.size(), kInfinite);
  // TODO: always go on from the node that is nearest to `from` and was not gone on from yet. A
  // std::priority_queue of pairs (distance, node) has it on top.
  notUsedYet(network, from);
  return distances;
}

std::vector<std::size_t> wayDown(const Network& network, const std::vector<double>& distances,
                                 std::size_t start) {
  // TODO: from node to node downwards. Is the lowest neighbour always on a shortest way?
  notUsedYet(network, distances, start);
  return {};
}

double fieldPotential(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                      const Eigen::Vector2d& p) {
  double U = 0;
  // TODO: both potentials. Which blocks are felt at p?
  notUsedYet(yard, goal, gains, p);
  return U;
}

Eigen::Vector2d fieldGradient(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                              const Eigen::Vector2d& p) {
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  // TODO: the derivative of the potential. Of the distance to a block, what is the gradient?
  notUsedYet(yard, goal, gains, p);
  return gradient;
}

FieldTrail slideDown(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                     const Eigen::Vector2d& start, double stepSize) {
  FieldTrail trail{.ending = Ending::kStuck, .points = {start}};
  // TODO: steps against the gradient, shorter where a whole one would lead upwards.
  notUsedYet(yard, goal, gains, stepSize);
  return trail;
}

bool straightIsFree(const Yard& yard, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double resolution) {
  // TODO: how many points does it take?
  notUsedYet(yard, a, b, resolution);
  return false;
}

std::optional<Eigen::Vector2d> uniformSample(const Yard& yard, Rng& rng) {
  // TODO: a point of the yard, if it is free.
  notUsedYet(yard, rng);
  return std::nullopt;
}

std::optional<Eigen::Vector2d> gaussianSample(const Yard& yard, double sigma, Rng& rng) {
  // TODO: two points. When is one of them a node, and which?
  notUsedYet(yard, sigma, rng);
  return std::nullopt;
}

std::optional<Eigen::Vector2d> bridgeSample(const Yard& yard, double sigma, Rng& rng) {
  // TODO: two points, and the one between. Which of the three have to be free?
  notUsedYet(yard, sigma, rng);
  return std::nullopt;
}

// The k of the nodes that are nearest to q, nearest first.
std::vector<std::size_t> nearestNodes(const std::vector<Eigen::Vector2d>& nodes, const Eigen::Vector2d& q,
                                      int k) {
  std::vector<std::size_t> order;
  // TODO: useful for the next two. std::partial_sort sorts no more than you need.
  notUsedYet(nodes, q, k);
  return order;
}

Network joinNearest(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes, int k, double resolution) {
  Network roadmap(nodes.size());
  // TODO: slide 4:31, from line 6 on.
  notUsedYet(yard, k, resolution);
  return roadmap;
}

std::vector<Eigen::Vector2d> queryRoadmap(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes,
                                          const Network& roadmap, const Eigen::Vector2d& start,
                                          const Eigen::Vector2d& goal, int k, double resolution) {
  std::vector<Eigen::Vector2d> way;
  // TODO: two more nodes, and then you have all you need.
  notUsedYet(yard, nodes, roadmap, start, goal, k, resolution);
  return way;
}

double emptyMapDistance(Cell from, Cell to) {
  // TODO: how many diagonal steps, and how many straight ones?
  notUsedYet(from, to);
  return 0;
}

std::vector<std::size_t> aStar(const std::function<std::vector<Arc>(std::size_t)>& arcsOf, std::size_t start,
                               std::size_t goal, const std::vector<double>& estimates) {
  std::vector<std::size_t> way;
  // TODO: Dijkstra, but what is on top of the queue? When may it stop, and how do you find the way back?
  notUsedYet(arcsOf, start, goal, estimates);
  return way;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

void showBug(const CellMap& map, Cell start, Cell goal, const std::vector<Eigen::Vector2d>& byLibrary) {
  const std::vector<Cell> line = straightCells(start, goal);
  const BugTrail trail = bugTwo(line, [&](Cell cell) { return map.isFree(cell); });
  Figure figure = planOf("Bug 2", map);
  addLine(figure, centersOf(line), {.label = "m-line", .color = kGray});
  addLine(figure, centersOf(trail.cells), {.label = "yours", .size = 2});
  addLine(figure, byLibrary, {.label = "library", .dashed = true, .color = kBlack});
  addEnds(figure, centerOf(start), centerOf(goal));
  plot("bug", figure);

  Simulator S = sceneOf(map, start, goal);
  std::vector<Eigen::Vector3d> mLine;
  for (const Eigen::Vector2d& p : centersOf(line)) mLine.emplace_back(p.x(), p.y(), 0.03);
  for (std::size_t i = 1; i < trail.cells.size(); ++i)
    for (const double share : {0.25, 0.5, 0.75, 1.})
      S.setJointAngles((1 - share) * centerOf(trail.cells[i - 1]) + share * centerOf(trail.cells[i]) -
                       centerOf(start));
  const PictureOptions look{
      .caption = "Bug 2", .traces = {"robot"}, .paths = {mLine}, .view = {0, -0.7, 1}, .width = 800};
  writeVideo(S, "bug", look, 300);
  writeContactSheet(S, "bug_sheet", look, 6, 300);
  writeReplay(S, "bug", look, {figure}, 300);
}

void showGrid(const std::vector<double>& byLibrary) {
  const CellMap map = roomMap();
  const std::vector<int> waves = waveNumbers(map, kRoomGoal);
  Figure figure = planOf("The wavefront from the goal", map);
  addNumbers(figure, map, "number", {waves.begin(), waves.end()}, 2);
  addEnds(figure, centerOf(kRoomStart), centerOf(kRoomGoal));
  plot("wavefront", figure);

  const Network network = cellNetwork(map);
  const std::vector<double> distances = dijkstra(network, map.placeOf(kRoomGoal));
  figure = planOf("Distances by Dijkstra, and the way down", map);
  addNumbers(figure, map, "distance [m]", distances, 0);
  addLine(figure, centersOf(map, wayDown(network, distances, map.placeOf(kRoomStart))),
          {.size = 2, .color = kRed});
  addEnds(figure, centerOf(kRoomStart), centerOf(kRoomGoal));
  plot("distances", figure);
  double difference = 0;
  for (std::size_t place = 0; place < byLibrary.size(); ++place)
    if (std::isfinite(byLibrary[place]))
      difference = std::max(difference, std::abs(distances[place] - byLibrary[place]));
  print("largest difference between your distances and the library's [m]", difference);
}

void showField() {
  const Yard yard = trapYard();
  const FieldGains gains{1, 0.1, 0.8};
  const auto U = [&](double x, double y) {
    return std::min(fieldPotential(yard, kTrapGoal, gains, {x, y}), 50.);
  };
  const auto force = [&](const Eigen::Vector2d& p) {
    return isFree(yard, p) ? Eigen::Vector2d(-fieldGradient(yard, kTrapGoal, gains, p))
                           : Eigen::Vector2d(0, 0);
  };
  Figure figure = planOf("A potential field, and where it leads", yard.size, yard.blocks);
  figure.colorLabel = "U, 50 J at most";
  figure.heatMap = heatMapOf(U, {0, yard.size.x()}, {0, yard.size.y()}, 200, 120);
  figure.heatMap->contours = 25;
  Arrows arrows = arrowsOf(force, {0.2, yard.size.x() - 0.2}, {0.2, yard.size.y() - 0.2}, 25, 15);
  arrows.color = Color{1, 1, 1};
  if (!arrows.x.empty()) figure.arrows = {arrows};
  for (const double y : {0.3, 1.2, 2.4, 3., 3.9, 5., 5.7}) {
    const FieldTrail trail = slideDown(yard, kTrapGoal, gains, {0.5, y}, 0.05);
    const bool isStuck = trail.ending == Ending::kStuck;
    addLine(figure, trail.points, {.size = 1.5, .color = isStuck ? kRed : kBlack});
    if (isStuck)
      addLine(figure, {trail.points.back()},
              {.style = SeriesStyle::kPoints, .marker = Marker::kCross, .size = 3, .color = kRed});
  }
  addLine(figure, {kTrapGoal},
          {.style = SeriesStyle::kPoints, .marker = Marker::kDot, .size = 2.5, .color = Color{1, 1, 1}});
  plot("field", figure);
}

constexpr int kNeighbors = 8;
constexpr double kResolution = 0.02, kSigma = 0.3;

enum class Strategy { kUniform, kGaussian, kBridge };

// Half of the nodes are uniform, whatever the strategy: bridges alone join nothing but bridges.
std::vector<Eigen::Vector2d> nodesOf(const Yard& yard, Strategy strategy, int count, Rng& rng) {
  std::vector<Eigen::Vector2d> nodes;
  for (int attempt = 0; attempt < 400 * count && std::ssize(nodes) < count; ++attempt) {
    const bool isUniform = strategy == Strategy::kUniform || 2 * std::ssize(nodes) < count;
    const auto q = isUniform                         ? uniformSample(yard, rng)
                   : strategy == Strategy::kGaussian ? gaussianSample(yard, kSigma, rng)
                                                     : bridgeSample(yard, kSigma, rng);
    if (q) nodes.push_back(*q);
  }
  return nodes;
}

void addRoadmap(Figure& figure, const Yard& yard, Strategy strategy, const Eigen::Vector2d& shift) {
  Rng rng(7);
  const std::vector<Eigen::Vector2d> nodes = nodesOf(yard, strategy, 80, rng);
  const Network roadmap = joinNearest(yard, nodes, kNeighbors, kResolution);
  const auto shifted = [&](std::vector<Eigen::Vector2d> points) {
    for (Eigen::Vector2d& p : points) p += shift;
    return points;
  };
  std::vector<bool> isSeen(nodes.size());
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (isSeen[node]) continue;
    std::vector<std::size_t> line;
    walkArcs(roadmap, node, isSeen, line);
    std::vector<Eigen::Vector2d> points;
    for (const std::size_t i : line) points.push_back(nodes[i]);
    addLine(figure, shifted(points), {.size = 0.5, .color = kGray});
  }
  addLine(figure, shifted(nodes),
          {.style = SeriesStyle::kPoints, .marker = Marker::kDot, .color = Color{0, 0.45, 0.7}});
  addLine(figure, shifted(queryRoadmap(yard, nodes, roadmap, kSlotStart, kSlotGoal, kNeighbors, kResolution)),
          {.size = 2, .color = kRed});
}

void showRoadmaps() {
  const Yard yard = slotYard(1.7, 0.2);
  Figure figure{.title = "80 nodes: uniform; half of them Gaussian; half of them bridges",
                .xLabel = "x [m]",
                .yLabel = "y [m]",
                .equalAxes = true,
                .xRange = AxisRange{-0.2, 20.2},
                .yRange = AxisRange{-0.2, 4.2},
                .legend = Legend::kNone,
                .width = 1600,
                .height = 460};
  for (const Strategy strategy : {Strategy::kUniform, Strategy::kGaussian, Strategy::kBridge}) {
    const Eigen::Vector2d shift(7 * static_cast<double>(strategy), 0);
    for (const Block& block : yard.blocks)
      figure.regions.push_back(rectangle(block.lower + shift, block.upper + shift));
    addRoadmap(figure, yard, strategy, shift);
  }
  plot("roadmaps", figure);

  Figure rates{.title = "A slot 20 cm wide: how often a way is found",
               .xLabel = "nodes",
               .yLabel = "share of 50 runs",
               .yRange = AxisRange{0, 1},
               .legend = Legend::kOutside};
  const std::vector<std::pair<std::string, Strategy>> strategies = {{"uniform", Strategy::kUniform},
                                                                    {"half Gaussian", Strategy::kGaussian},
                                                                    {"half bridges", Strategy::kBridge}};
  for (const auto& [label, strategy] : strategies) {
    Series& series = rates.series.emplace_back(Series{.label = label, .style = SeriesStyle::kLinesPoints});
    for (const int count : {20, 40, 80, 120, 160}) {
      double found = 0;
      for (std::uint64_t run = 0; run < 50; ++run) {
        Rng rng(run);
        const Yard slot = slotYard(rng.uniform(1, 2.8), 0.2);
        const std::vector<Eigen::Vector2d> nodes = nodesOf(slot, strategy, count, rng);
        const Network roadmap = joinNearest(slot, nodes, kNeighbors, kResolution);
        const auto way = queryRoadmap(slot, nodes, roadmap, kSlotStart, kSlotGoal, kNeighbors, kResolution);
        found += way.empty() ? 0 : 1;
      }
      series.x.push_back(count);
      series.y.push_back(found / 50);
    }
  }
  plot("passage", rates);
}

// Which cells are asked for their arcs, and when: without an estimate, and with yours.
void showSearches() {
  const CellMap map = roomMap();
  const Network network = cellNetwork(map);
  for (const bool isInformed : {false, true}) {
    std::vector<double> estimates(network.size(), 0), order(network.size(), 0);
    for (std::size_t place = 0; isInformed && place < network.size(); ++place)
      estimates[place] = emptyMapDistance(map.cellAt(place), kRoomGoal);
    double asked = 0;
    const auto arcsOf = [&](std::size_t node) {
      order[node] = ++asked;
      return network[node];
    };
    const auto way = aStar(arcsOf, map.placeOf(kRoomStart), map.placeOf(kRoomGoal), estimates);
    const std::string name = isInformed ? "A*" : "Without an estimate";
    Figure figure = planOf(name + ": " + std::to_string(static_cast<int>(asked)) + " cells looked at", map);
    addNumbers(figure, map, "when", order, 1);
    figure.colorRange = AxisRange{0, 500};
    addLine(figure, centersOf(map, way), {.size = 2, .color = kRed});
    addEnds(figure, centerOf(kRoomStart), centerOf(kRoomGoal));
    plot(isInformed ? "astar" : "uninformed", figure);
  }
}

}  // namespace

int main() {
  // Once your own bug and distances work, they are those of the library.
  const auto gridMapOf = [](const CellMap& map) {
    GridMap grid(map.width, map.height);
    for (std::size_t place = 0; place < map.blocked.size(); ++place)
      grid.setBlocked({map.cellAt(place).x, map.cellAt(place).y}, map.blocked[place] != 0);
    return grid;
  };
  std::vector<Eigen::Vector2d> byLibrary;
  const GridMap hook = gridMapOf(hookMap());
  for (const GridCell cell : bug2(hook, {kHookStart.x, kHookStart.y}, {kHookGoal.x, kHookGoal.y}).cells)
    byLibrary.push_back(hook.center(cell));
  showBug(hookMap(), kHookStart, kHookGoal, byLibrary);
  showGrid(gridDistances(gridMapOf(roomMap()), {kRoomGoal.x, kRoomGoal.y}, Connectivity::kEightWithRoom));
  showField();
  showRoadmaps();
  showSearches();
}
