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

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Right, up, left, down: plus one is a quarter turn to the left, whatever the sign of the heading.
MapCell ahead(MapCell cell, int heading) {
  const std::array<MapCell, 4> steps = {MapCell{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const MapCell step = steps[static_cast<std::size_t>(heading & 3)];
  return {cell.x + step.x, cell.y + step.y};
}

BugTrail bugTwo(const std::vector<MapCell>& mLine, const std::function<bool(MapCell)>& isFree) {
  BugTrail trail{.reached = false, .cells = {mLine.front()}};
  // <solution bugTwo>
  // With the left hand on the wall: as far to the left as it can turn, but not back if there is another way.
  const auto leftmost = [&](MapCell cell, int heading) {
    for (int turn = 0; turn < 4; ++turn, --heading)
      if (isFree(ahead(cell, heading))) return heading;
    return heading;
  };
  for (std::size_t at = 0; at + 1 < mLine.size();) {
    if (isFree(mLine[at + 1])) {
      trail.cells.push_back(mLine[++at]);
      continue;
    }
    MapCell cell = mLine[at];
    int heading = 0;
    while (ahead(cell, heading) != mLine[at + 1]) ++heading;
    heading = leftmost(cell, heading - 1);
    const int first = heading;
    if (!isFree(ahead(cell, heading))) return trail;
    const std::size_t hit = at;
    do {
      cell = ahead(cell, heading);
      trail.cells.push_back(cell);
      heading = leftmost(cell, heading + 1);
      const auto onLine = std::find(mLine.begin() + static_cast<std::ptrdiff_t>(hit), mLine.end(), cell);
      if (onLine != mLine.end()) at = static_cast<std::size_t>(onLine - mLine.begin());
      if (at == hit && cell == mLine[hit] && ((heading - first) & 3) == 0) return trail;
    } while (at == hit);
  }
  trail.reached = true;
  // <todo>
  //| // TODO: along the line while it is free; else around the obstacle, until the line is met nearer to the
  //| // goal. Which heading comes first if one hand stays on the wall? How does the bug know it is round?
  // </solution>
  return trail;
}

std::vector<int> waveNumbers(const CellMap& map, MapCell goal) {
  std::vector<int> numbers = map.blocked;
  // <solution waveNumbers>
  numbers[map.placeOf(goal)] = 2;
  std::deque<MapCell> front = {goal};
  while (!front.empty()) {
    const MapCell cell = front.front();
    front.pop_front();
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
      for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
        if (!map.isFree({x, y}) || numbers[map.placeOf({x, y})] != 0) continue;
        numbers[map.placeOf({x, y})] = numbers[map.placeOf(cell)] + 1;
        front.push_back({x, y});
      }
    }
  }
  // <todo>
  //| // TODO: begin with 2 at the goal. Each cell of the front gives its number plus one to what is still 0.
  // </solution>
  return numbers;
}

Network cellNetwork(const CellMap& map) {
  Network network(map.blocked.size());
  // <solution cellNetwork>
  for (std::size_t here = 0; here < network.size(); ++here) {
    const MapCell at = map.cellAt(here);
    for (int y = at.y - 1; map.isFree(at) && y <= at.y + 1; ++y) {
      for (int x = at.x - 1; x <= at.x + 1; ++x) {
        // For a step to the side these two cells are both ends of it.
        const bool hasRoom = map.isFree({x, at.y}) && map.isFree({at.x, y});
        if (MapCell{x, y} == at || !map.isFree({x, y}) || !hasRoom) continue;
        network[here].push_back({map.placeOf({x, y}), x != at.x && y != at.y ? std::numbers::sqrt2 : 1});
      }
    }
  }
  // <todo>
  //| // TODO: arcs of each free cell to the free ones around it. Which diagonals are left out?
  // </solution>
  return network;
}

std::vector<double> dijkstra(const Network& network, std::size_t from) {
  std::vector<double> distances(network.size(), kInfinite);
  // <solution dijkstra>
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  distances[from] = 0;
  queue.emplace(0, from);
  while (!queue.empty()) {
    const auto [distance, node] = queue.top();
    queue.pop();
    if (distance > distances[node]) continue;  // it was reached on a shorter way since
    for (const Arc& arc : network[node]) {
      if (distance + arc.length >= distances[arc.to]) continue;
      distances[arc.to] = distance + arc.length;
      queue.emplace(distances[arc.to], arc.to);
    }
  }
  // <todo>
  //| // TODO: always go on from the node that is nearest to `from` and was not gone on from yet. A
  //| // std::priority_queue of pairs (distance, node) has it on top.
  // </solution>
  return distances;
}

std::vector<std::size_t> wayDown(const Network& network, const std::vector<double>& distances,
                                 std::size_t start) {
  // <solution wayDown>
  if (distances[start] == kInfinite) return {};
  std::vector<std::size_t> way = {start};
  while (distances[way.back()] > 0) {
    const std::vector<Arc>& arcs = network[way.back()];
    const auto total = [&](const Arc& arc) { return arc.length + distances[arc.to]; };
    const auto best = std::min_element(arcs.begin(), arcs.end(),
                                       [&](const Arc& a, const Arc& b) { return total(a) < total(b); });
    way.push_back(best->to);
  }
  return way;
  // <todo>
  //| // TODO: from node to node downwards. Is the lowest neighbour always on a shortest way?
  //| return {};
  // </solution>
}

double fieldPotential(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                      const Eigen::Vector2d& p) {
  double U = 0;
  // <solution fieldPotential>
  U = gains.attraction * (p - goal).squaredNorm() / 2;
  for (const Block& block : yard.blocks) {
    const double distance = (p - nearestPoint(block, p)).norm();
    if (distance >= gains.reach) continue;
    const double excess = 1 / distance - 1 / gains.reach;
    U += gains.repulsion * excess * excess / 2;
  }
  // <todo>
  //| // TODO: both potentials. Which blocks are felt at p?
  // </solution>
  return U;
}

Eigen::Vector2d fieldGradient(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                              const Eigen::Vector2d& p) {
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  // <solution fieldGradient>
  gradient = gains.attraction * (p - goal);
  for (const Block& block : yard.blocks) {
    // The distance grows fastest straight away from the nearest point.
    const Eigen::Vector2d away = p - nearestPoint(block, p);
    const double distance = away.norm();
    if (distance >= gains.reach) continue;
    const double excess = 1 / distance - 1 / gains.reach;
    gradient -= gains.repulsion * excess / (distance * distance * distance) * away;
  }
  // <todo>
  //| // TODO: the derivative of the potential. Of the distance to a block, what is the gradient?
  // </solution>
  return gradient;
}

FieldTrail slideDown(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                     const Eigen::Vector2d& start, double stepSize) {
  FieldTrail trail{.ending = Ending::kStuck, .points = {start}};
  // <solution slideDown>
  while ((trail.points.back() - goal).norm() > stepSize) {
    const Eigen::Vector2d p = trail.points.back(), gradient = fieldGradient(yard, goal, gains, p);
    const double slope = gradient.norm(), U = fieldPotential(yard, goal, gains, p);
    if (slope < 0.01 * gains.attraction) return trail;
    // Backtracking as in exercise 00: a step has to bring a share of what its slope promises.
    double step = stepSize;
    const auto next = [&] { return Eigen::Vector2d(p - step / slope * gradient); };
    while (!(fieldPotential(yard, goal, gains, next()) < U - 0.1 * slope * step)) step /= 2;
    trail.points.push_back(next());
  }
  trail.ending = Ending::kAtGoal;
  // <todo>
  //| // TODO: steps against the gradient, shorter where a whole one would lead upwards.
  // </solution>
  return trail;
}

bool straightIsFree(const Yard& yard, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double resolution) {
  // <solution straightIsFree>
  const double count = std::ceil((b - a).norm() / resolution);
  for (double i = 0; i < count; ++i)
    if (!isFree(yard, a + i / count * (b - a))) return false;
  return isFree(yard, b);
  // <todo>
  //| // TODO: how many points does it take?
  //| return false;
  // </solution>
}

std::optional<Eigen::Vector2d> uniformSample(const Yard& yard, Rng& rng) {
  // <solution uniformSample>
  const double x = rng.uniform(0, yard.size.x()), y = rng.uniform(0, yard.size.y());
  if (!isFree(yard, {x, y})) return std::nullopt;
  return Eigen::Vector2d(x, y);
  // <todo>
  //| // TODO: a point of the yard, if it is free.
  //| return std::nullopt;
  // </solution>
}

std::optional<Eigen::Vector2d> gaussianSample(const Yard& yard, double sigma, Rng& rng) {
  // <solution gaussianSample>
  const double x = rng.uniform(0, yard.size.x()), y = rng.uniform(0, yard.size.y());
  const Eigen::Vector2d q1(x, y), q2 = q1 + sigma * rng.normalVector(2);
  if (isFree(yard, q1) == isFree(yard, q2)) return std::nullopt;
  return isFree(yard, q1) ? q1 : q2;
  // <todo>
  //| // TODO: two points. When is one of them a node, and which?
  //| return std::nullopt;
  // </solution>
}

std::optional<Eigen::Vector2d> bridgeSample(const Yard& yard, double sigma, Rng& rng) {
  // <solution bridgeSample>
  const double x = rng.uniform(0, yard.size.x()), y = rng.uniform(0, yard.size.y());
  const Eigen::Vector2d q1(x, y), q2 = q1 + sigma * rng.normalVector(2), middle = (q1 + q2) / 2;
  if (isFree(yard, q1) || isFree(yard, q2) || !isFree(yard, middle)) return std::nullopt;
  return middle;
  // <todo>
  //| // TODO: two points, and the one between. Which of the three have to be free?
  //| return std::nullopt;
  // </solution>
}

// The k of the nodes that are nearest to q, nearest first.
std::vector<std::size_t> nearestNodes(const std::vector<Eigen::Vector2d>& nodes, const Eigen::Vector2d& q,
                                      int k) {
  std::vector<std::size_t> order;
  // <solution nearestNodes>
  for (std::size_t i = 0; i < nodes.size(); ++i) order.push_back(i);
  const auto last = order.begin() + std::min<std::ptrdiff_t>(k, std::ssize(order));
  std::partial_sort(order.begin(), last, order.end(), [&](std::size_t i, std::size_t j) {
    return (nodes[i] - q).squaredNorm() < (nodes[j] - q).squaredNorm();
  });
  order.erase(last, order.end());
  // <todo>
  //| // TODO: useful for the next two. std::partial_sort sorts no more than you need.
  // </solution>
  return order;
}

Network joinNearest(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes, int k, double resolution) {
  Network roadmap(nodes.size());
  // <solution joinNearest>
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::size_t j : nearestNodes(nodes, nodes[i], k + 1)) {  // the first is the node itself
      const auto isTo = [&](const Arc& arc) { return arc.to == j; };
      if (i == j || std::any_of(roadmap[i].begin(), roadmap[i].end(), isTo)) continue;
      if (!straightIsFree(yard, nodes[i], nodes[j], resolution)) continue;
      const double length = (nodes[i] - nodes[j]).norm();
      roadmap[i].push_back({j, length});
      roadmap[j].push_back({i, length});
    }
  }
  // <todo>
  //| // TODO: slide 4:31, from line 6 on.
  // </solution>
  return roadmap;
}

std::vector<Eigen::Vector2d> queryRoadmap(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes,
                                          const Network& roadmap, const Eigen::Vector2d& start,
                                          const Eigen::Vector2d& goal, int k, double resolution) {
  std::vector<Eigen::Vector2d> way;
  // <solution queryRoadmap>
  Network network = roadmap;
  std::vector<Eigen::Vector2d> places = nodes;
  for (const Eigen::Vector2d& end : {start, goal}) {
    const std::size_t added = network.size();
    places.push_back(end);
    network.emplace_back();
    for (const std::size_t i : nearestNodes(nodes, end, k)) {
      if (!straightIsFree(yard, end, nodes[i], resolution)) continue;
      network[added].push_back({i, (end - nodes[i]).norm()});
      network[i].push_back({added, (end - nodes[i]).norm()});
    }
  }
  const std::size_t first = nodes.size(), last = first + 1;
  for (const std::size_t node : wayDown(network, dijkstra(network, last), first)) way.push_back(places[node]);
  // <todo>
  //| // TODO: two more nodes, and then you have all you need.
  // </solution>
  return way;
}

double emptyMapDistance(MapCell from, MapCell to) {
  // <solution emptyMapDistance>
  const int across = std::abs(to.x - from.x), along = std::abs(to.y - from.y);
  return std::max(across, along) + (std::numbers::sqrt2 - 1) * std::min(across, along);
  // <todo>
  //| // TODO: how many diagonal steps, and how many straight ones?
  //| return 0;
  // </solution>
}

std::vector<std::size_t> aStar(const std::function<std::vector<Arc>(std::size_t)>& arcsOf, std::size_t start,
                               std::size_t goal, const std::vector<double>& estimates) {
  std::vector<std::size_t> way;
  // <solution aStar>
  std::vector<double> lengths(estimates.size(), kInfinite);
  std::vector<std::size_t> from(estimates.size(), start);
  std::vector<bool> isDone(estimates.size());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  lengths[start] = 0;
  queue.emplace(estimates[start], start);
  while (!queue.empty() && queue.top().second != goal) {
    const std::size_t node = queue.top().second;
    queue.pop();
    if (isDone[node]) continue;
    isDone[node] = true;
    for (const Arc& arc : arcsOf(node)) {
      const double length = lengths[node] + arc.length;
      if (length >= lengths[arc.to]) continue;
      lengths[arc.to] = length;
      from[arc.to] = node;
      queue.emplace(length + estimates[arc.to], arc.to);
    }
  }
  if (lengths[goal] == kInfinite) return {};
  for (std::size_t node = goal; node != start; node = from[node]) way.push_back(node);
  way.push_back(start);
  std::reverse(way.begin(), way.end());
  // <todo>
  //| // TODO: Dijkstra, but what is on top of the queue? When may it stop, and how do you find the way back?
  // </solution>
  return way;
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

void showBug(const CellMap& map, MapCell start, MapCell goal, const std::vector<Eigen::Vector2d>& byLibrary) {
  const std::vector<MapCell> line = straightCells(start, goal);
  const BugTrail trail = bugTwo(line, [&](MapCell cell) { return map.isFree(cell); });
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
