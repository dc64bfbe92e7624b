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
  // TODO: along the line while it is free; else around the obstacle, until the line is met nearer to the
  // goal. Which heading comes first if one hand stays on the wall? How does the bug know it is round?
  return trail;
}

std::vector<int> waveNumbers(const CellMap& map, MapCell goal) {
  std::vector<int> numbers = map.blocked;
  // TODO: begin with 2 at the goal. Each cell of the front gives its number plus one to what is still 0.
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
  return distances;
}

std::vector<std::size_t> wayDown(const Network& network, const std::vector<double>& distances,
                                 std::size_t start) {
  // TODO: from node to node downwards. Is the lowest neighbour always on a shortest path?
  return {};
}

double fieldPotential(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                      const Eigen::Vector2d& p) {
  double U = 0;
  // TODO: both potentials. Which blocks are felt at p?
  return U;
}

Eigen::Vector2d fieldGradient(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                              const Eigen::Vector2d& p) {
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  // TODO: the derivative of the potential. Of the distance to a block, what is the gradient?
  return gradient;
}

FieldTrail slideDown(const Yard& yard, const Eigen::Vector2d& goal, const FieldGains& gains,
                     const Eigen::Vector2d& start, double stepSize) {
  FieldTrail trail{.ending = Ending::kStuck, .points = {start}};
  // TODO: steps against the gradient, shorter where a whole one would lead upwards.
  return trail;
}

bool straightIsFree(const Yard& yard, const Eigen::Vector2d& a, const Eigen::Vector2d& b, double resolution) {
  // TODO: how many points does it take?
  return false;
}

std::optional<Eigen::Vector2d> uniformSample(const Yard& yard, Rng& rng) {
  // TODO: a point of the yard, if it is free.
  return std::nullopt;
}

std::optional<Eigen::Vector2d> gaussianSample(const Yard& yard, double sigma, Rng& rng) {
  // TODO: two points. When is one of them a node, and which?
  return std::nullopt;
}

std::optional<Eigen::Vector2d> bridgeSample(const Yard& yard, double sigma, Rng& rng) {
  // TODO: two points, and the one between. Which of the three have to be free?
  return std::nullopt;
}

// The k of the nodes that are nearest to q, nearest first.
std::vector<std::size_t> nearestNodes(const std::vector<Eigen::Vector2d>& nodes, const Eigen::Vector2d& q,
                                      int k) {
  std::vector<std::size_t> order;
  // TODO: useful for the next two. std::partial_sort sorts no more than you need.
  return order;
}

Network joinNearest(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes, int k, double resolution) {
  Network roadmap(nodes.size());
  // TODO: slide 4:31, from line 6 on.
  return roadmap;
}

std::vector<Eigen::Vector2d> queryRoadmap(const Yard& yard, const std::vector<Eigen::Vector2d>& nodes,
                                          const Network& roadmap, const Eigen::Vector2d& start,
                                          const Eigen::Vector2d& goal, int k, double resolution) {
  std::vector<Eigen::Vector2d> way;
  // TODO: two more nodes, and then you have all you need.
  return way;
}

double emptyMapDistance(MapCell from, MapCell to) {
  // TODO: how many diagonal steps, and how many straight ones?
  return 0;
}

std::vector<std::size_t> aStar(const std::function<std::vector<Arc>(std::size_t)>& arcsOf, std::size_t start,
                               std::size_t goal, const std::vector<double>& estimates) {
  std::vector<std::size_t> way;
  // TODO: Dijkstra, but what is on top of the queue? When may it stop, and how do you find the way back?
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
