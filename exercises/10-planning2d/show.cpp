#include "show.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "drawing.h"
#include "maps.h"
#include "planning/bug.h"

using namespace rex;

namespace {

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

GridMap gridMapOf(const CellMap& map) {
  GridMap copy(map.width, map.height);
  for (std::size_t place = 0; place < map.blocked.size(); ++place)
    copy.setBlocked({map.cellAt(place).x, map.cellAt(place).y}, map.blocked[place] != 0);
  return copy;
}

}  // namespace

void showBug(const CellMap& map, MapCell start, MapCell goal) {
  const std::vector<MapCell> line = straightCells(start, goal);
  const BugTrail trail = bugTwo(line, [&](MapCell cell) { return map.isFree(cell); });
  if (trail.cells.size() < 2) return nothingYet("the bug");
  const GridMap grid = gridMapOf(map);
  std::vector<Eigen::Vector2d> byLibrary;
  for (const GridCell cell : bug2(grid, {start.x, start.y}, {goal.x, goal.y}).cells)
    byLibrary.push_back(grid.center(cell));
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

void showDistances(const CellMap& map, MapCell start, MapCell goal) {
  const std::vector<int> waves = waveNumbers(map, goal);
  if (waves == map.blocked) return nothingYet("the wavefront");
  Figure figure = planOf("The wavefront from the goal", map);
  addNumbers(figure, map, "number", {waves.begin(), waves.end()}, 2);
  addEnds(figure, centerOf(start), centerOf(goal));
  plot("wavefront", figure);

  const Network network = cellNetwork(map);
  const std::vector<double> distances = dijkstra(network, map.placeOf(goal));
  if (!std::isfinite(distances[map.placeOf(goal)])) return nothingYet("distances");
  figure = planOf("Distances by Dijkstra, and the way down", map);
  addNumbers(figure, map, "distance [m]", distances, 0);
  addLine(figure, centersOf(map, wayDown(network, distances, map.placeOf(start))),
          {.size = 2, .color = kRed});
  addEnds(figure, centerOf(start), centerOf(goal));
  plot("distances", figure);
  const std::vector<double> byLibrary =
      gridDistances(gridMapOf(map), {goal.x, goal.y}, Connectivity::kEightWithRoom);
  double difference = 0;
  for (std::size_t place = 0; place < byLibrary.size(); ++place)
    if (std::isfinite(byLibrary[place]))
      difference = std::max(difference, std::abs(distances[place] - byLibrary[place]));
  print("largest difference between your distances and the library's [m]", difference);
}

void showField(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains) {
  if (fieldPotential(yard, goal, gains, {0.5, 3}) == 0) return nothingYet("the field");
  const auto U = [&](double x, double y) { return std::min(fieldPotential(yard, goal, gains, {x, y}), 50.); };
  const auto force = [&](const Eigen::Vector2d& p) {
    return isFree(yard, p) ? Eigen::Vector2d(-fieldGradient(yard, goal, gains, p)) : Eigen::Vector2d(0, 0);
  };
  Figure figure = planOf("A potential field, and where it leads", yard.size, yard.blocks);
  figure.colorLabel = "U, 50 J at most";
  figure.heatMap = sampledHeatMap(U, {0, yard.size.x()}, {0, yard.size.y()}, 200, 120);
  figure.heatMap->contours = 25;
  Arrows arrows = arrowField(force, {0.2, yard.size.x() - 0.2}, {0.2, yard.size.y() - 0.2}, 25, 15);
  arrows.color = Color{1, 1, 1};
  if (!arrows.x.empty()) figure.arrows = {arrows};
  for (const double y : {0.3, 1.2, 2.4, 3., 3.9, 5., 5.7}) {
    const FieldTrail trail = slideDown(yard, goal, gains, {0.5, y}, 0.05);
    const bool isStuck = trail.ending == Ending::kStuck;
    addLine(figure, trail.points, {.size = 1.5, .color = isStuck ? kRed : kBlack});
    if (isStuck)
      addLine(figure, {trail.points.back()},
              {.style = SeriesStyle::kPoints, .marker = Marker::kCross, .size = 3, .color = kRed});
  }
  addLine(figure, {goal},
          {.style = SeriesStyle::kPoints, .marker = Marker::kDot, .size = 2.5, .color = Color{1, 1, 1}});
  plot("field", figure);
}

void showRoadmaps(double width) {
  const Yard yard = slotYard(1.7, width);
  Rng seed(1);
  if (nodesOf(yard, Strategy::kUniform, 1, seed).empty()) return nothingYet("roadmaps");
  Figure figure = planeFigure({.title = "80 nodes: uniform; half of them Gaussian; half of them bridges",
                               .xRange = AxisRange{-0.2, 20.2},
                               .yRange = AxisRange{-0.2, 4.2},
                               .legend = Legend::kNone,
                               .width = 1600,
                               .height = 460});
  for (const Strategy strategy : {Strategy::kUniform, Strategy::kGaussian, Strategy::kBridge}) {
    const Eigen::Vector2d shift(7 * static_cast<double>(strategy), 0);
    for (const Block& block : yard.blocks)
      figure.regions.push_back(rectangle(block.lower + shift, block.upper + shift));
    addRoadmap(figure, yard, strategy, shift);
  }
  plot("roadmaps", figure);

  Figure rates{
      .title = "A slot " + std::to_string(std::lround(100 * width)) + " cm wide: how often a way is found",
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
        const Yard slot = slotYard(rng.uniform(1, 2.8), width);
        const std::vector<Eigen::Vector2d> nodes = nodesOf(slot, strategy, count, rng);
        const Network roadmap = joinNearest(slot, nodes, kNeighbors, kResolution);
        const auto way = queryRoadmap(slot, nodes, roadmap, kSlotStart, kSlotGoal, kNeighbors, kResolution);
        found += way.empty() ? 0 : 1;
      }
      series.add(count, found / 50);
    }
  }
  plot("passage", rates);
}

void showSearches(const CellMap& map, MapCell start, MapCell goal) {
  const Network network = cellNetwork(map);
  for (const bool isInformed : {false, true}) {
    std::vector<double> estimates(network.size(), 0), order(network.size(), 0);
    for (std::size_t place = 0; isInformed && place < network.size(); ++place)
      estimates[place] = emptyMapDistance(map.cellAt(place), goal);
    double asked = 0;
    const auto arcsOf = [&](std::size_t node) {
      order[node] = ++asked;
      return network[node];
    };
    const auto way = aStar(arcsOf, map.placeOf(start), map.placeOf(goal), estimates);
    if (asked == 0) return nothingYet("A*");
    const std::string name = isInformed ? "A*" : "Without an estimate";
    Figure figure = planOf(name + ": " + std::to_string(static_cast<int>(asked)) + " cells looked at", map);
    addNumbers(figure, map, "when", order, 1);
    figure.colorRange = AxisRange{0, 500};
    addLine(figure, centersOf(map, way), {.size = 2, .color = kRed});
    addEnds(figure, centerOf(start), centerOf(goal));
    plot(isInformed ? "astar" : "uninformed", figure);
  }
}
