#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "exercise.h"
#include "maps.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

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
  //| // TODO: from node to node downwards. Is the lowest neighbour always on a shortest path?
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

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: from one side of a hook to the other.
  showBug(hookMap(), kHookStart, kHookGoal);

  // Part 2: rooms with doors.
  showDistances(roomMap(), kRoomStart, kRoomGoal);

  // Part 3: a yard with a trap between where trails begin, at the left, and the goal.
  showField(trapYard(), kTrapGoal, {.attraction = 1, .repulsion = .1, .reach = .8});

  // Part 4: yards with a slot in a wall, 20 cm wide.
  showRoadmaps(.2);

  // Part 5: the rooms again.
  showSearches(roomMap(), kRoomStart, kRoomGoal);
}
