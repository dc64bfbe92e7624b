#include "grading/check.h"

#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "bug_checks.h"
#include "field_checks.h"
#include "grid_checks.h"
#include "interface.h"
#include "plan_evidence.h"
#include "roadmap_checks.h"
#include "sampler_checks.h"
#include "yard_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1.

// A pocket on each side of the cell where the bug meets the obstacle; it passes this cell again on its way
// out.
CellMap pocketMap() {
  return mapOf({"..............", "....###.......", "....#.#.......", "....#.#.......", "...##.#.......",
                "......#.......", "...##.#.......", "....#.#.......", "....#.#.......", "....###.......",
                ".............."});
}

void bugsOnKnownMaps(Check& check, Student& student) {
  check.input("a map without obstacles, in four directions");
  const CellMap meadow = mapOf(std::vector<std::string>(9, std::string(12, '.')));
  for (const MapCell goal : {MapCell{11, 8}, {0, 0}, {10, 1}, {2, 8}})
    bugObeys(check, student, meadow, {5, 4}, goal);
  check.input("hookMap() of maps.h");
  bugObeys(check, student, hookMap(), kHookStart, kHookGoal);
  bugObeys(check, student, hookMap(), kHookGoal, kHookStart);
  check.input("a wall with two pockets, from the middle of its left side to the right");
  bugObeys(check, student, pocketMap(), {0, 5}, {13, 5});
  check.input("roomMap() of maps.h");
  bugObeys(check, student, roomMap(), kRoomStart, kRoomGoal);
}

// A closed room, and the same with a door, so that a bug that never moves fails.
void bugsAndRooms(Check& check, Student& student) {
  for (const bool isOpen : {false, true}) {
    const std::string room = isOpen ? "a room with a door" : "a closed room";
    CellMap map = hookMap();
    enclose(map, kHookGoal, 1);
    if (isOpen) map.blocked[map.placeOf({kHookGoal.x, kHookGoal.y - 1})] = 0;
    check.input("hookMap() of maps.h, the goal in " + room);
    bugObeys(check, student, map, kHookStart, kHookGoal);
    check.input("hookMap() of maps.h, the start in " + room);
    bugObeys(check, student, map, kHookGoal, kHookStart);
    map = pocketMap();
    enclose(map, {1, 5}, 1);
    if (isOpen) map.blocked[map.placeOf({1, 4})] = 0;
    check.input("a wall with two pockets, the start in " + room);
    bugObeys(check, student, map, {1, 5}, {13, 5});
  }
}

// <hidden>
void bugsAnywhere(Check& check, Student& student) {
  check.forEachCase(16, [&](int i) {
    Rng& rng = check.rng();
    CellMap map = randomMap(rng, 22, 16);
    MapCell start = randomFreeCell(map, rng);
    const MapCell goal = randomFreeCell(map, rng);
    if (i % 4 == 3) enclose(map, goal, 2);
    while (start == goal || !map.isFree(start)) start = randomFreeCell(map, rng);
    bugObeys(check, student, map, start, goal);
  });
}
// </hidden>

// Part 2.

void wavesAgree(Check& check, Student& student, const CellMap& map, MapCell goal) {
  const std::string input = check.input();
  const std::vector<int> got = student.waveNumbers(map, goal),
                         wanted = wavefront(gridMapOf(map), {goal.x, goal.y}, Connectivity::kEight);
  MapCell here = goal;
  const auto shown = check.show([&] { return wavesSeen(map, goal, got, wanted, here); });
  check.near("number of numbers of waveNumbers", static_cast<double>(got.size()),
             static_cast<double>(wanted.size()), 0);
  check.near("number of the goal by waveNumbers", got[map.placeOf(goal)], 2, 0);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    here = map.cellAt(i);
    check.input(fmt::format("{}, cell {}, goal {}", input, nameOf(here), nameOf(goal)));
    check.near(
        map.isFree(here) ? "number of a free cell by waveNumbers" : "number of a blocked cell by waveNumbers",
        got[i], wanted[i], 0);
  }
}

void wavesOnKnownMaps(Check& check, Student& student) {
  check.input("the map of slide 4:18");
  CellMap map = mapOf(std::vector<std::string>(8, std::string(16, '.')));
  for (int x = 4; x < 12; ++x)
    for (const int y : {3, 4}) block(map, {x, y});
  wavesAgree(check, student, map, {15, 0});
  check.input("roomMap() of maps.h, and one of its rooms closed");
  map = roomMap();
  wavesAgree(check, student, map, kRoomGoal);
  for (const MapCell door : {MapCell{4, 11}, {8, 4}, {8, 3}, {4, 6}}) block(map, door);
  wavesAgree(check, student, map, kRoomGoal);
}

// `here` is the arc.
void arcFits(Check& check, const CellMap& map, const ArcEnds& here, double length) {
  const MapCell at = map.cellAt(here.from), end = map.cellAt(here.to);
  const std::string where = fmt::format("arc from {} to {}", nameOf(at), nameOf(end));
  holdsWhere(check, "arcs of cellNetwork join free cells that touch",
             map.isFree(at) && map.isFree(end) && touches(at, end) && !(at == end), where);
  holdsWhere(check, "no diagonal arc of cellNetwork cuts the corner of a blocked cell",
             map.isFree({end.x, at.y}) && map.isFree({at.x, end.y}), where);
  const auto one =
      check.ask("Are diagonal steps as long as the others? They are sqrt(2) m long.", length == 1);
  check.near("length of an arc of cellNetwork", length, std::hypot(end.x - at.x, end.y - at.y), 1e-12, "m");
}

void networkFits(Check& check, Student& student, const CellMap& map) {
  const Network network = student.cellNetwork(map), wanted = networkOf(map);
  ArcEnds here;
  const auto shown = check.show([&] {
    Points places;
    for (std::size_t place = 0; place < wanted.size(); ++place) places.push_back(centerOf(map.cellAt(place)));
    return networkSeen(planOf("The map as a network", map), places, network, wanted, wanted, here);
  });
  check.near("number of lists of arcs of cellNetwork", static_cast<double>(network.size()),
             static_cast<double>(map.blocked.size()), 0);
  const std::string input = check.input();
  for (std::size_t place = 0; place < network.size(); ++place) {
    std::set<std::size_t> ends;
    for (const auto& [to, length] : network[place]) {
      here = {place, to};
      check.that("arcs of cellNetwork lead to cells of the map", to < network.size());
      holdsWhere(check, "no arc of cellNetwork is there twice", ends.insert(to).second,
                 fmt::format("arc from {} to {}", nameOf(map.cellAt(place)), nameOf(map.cellAt(to))));
      arcFits(check, map, here, length);
    }
    here = {place, place};
    check.input(input + ", cell " + nameOf(map.cellAt(place)));
    check.near("number of arcs of a cell by cellNetwork", static_cast<double>(network[place].size()),
               static_cast<double>(wanted[place].size()), 0);
    check.input(input);
  }
}

void networksOfMaps(Check& check, Student& student) {
  check.input("a map of three by three cells, one of them blocked");
  networkFits(check, student, mapOf({"...", ".#.", "..."}));
  networkFits(check, student, mapOf({"#..", "...", "..."}));
  check.input("roomMap() of maps.h");
  networkFits(check, student, roomMap());
}

// With a reach of 0.1, points have 2.5 neighbours on average, and most cannot be reached.
void distancesOnNetworks(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    check.input("a random network");
    const RandomNetwork made = randomNetwork(check.rng(), 80, i % 2 == 0 ? 0.3 : 0.1, 3);
    const auto from = static_cast<std::size_t>(check.rng().index(80));
    const std::vector<double> wanted = slowDistances(made.network, from);
    std::size_t here = from;
    const auto shown = check.show([&] { return waySeen(made, {}, steepestWay(made.network, wanted, here)); });
    distancesAgree(check, made.network, student.dijkstra.orInfinite()(made.network, from), wanted, from,
                   here);
  });
}

// Given the right distances.
void waysDown(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    check.input("a random network with its distances");
    const RandomNetwork made = randomNetwork(check.rng(), 80, i % 2 == 0 ? 0.3 : 0.1, 3);
    const auto goal = static_cast<std::size_t>(check.rng().index(80));
    const std::vector<double> distances = slowDistances(made.network, goal);
    for (std::size_t start = 0; start < 80; start += 5) {
      const std::vector<std::size_t> way = student.wayDown(made.network, distances, start);
      const auto shown =
          check.show([&] { return waySeen(made, way, steepestWay(made.network, distances, start)); });
      const auto lowest = check.ask(
          "Does each step go to the neighbour with the lowest distance? Arcs differ in length, and the arc "
          "there "
          "counts, too.",
          std::isfinite(distances[start]) && way == steepestWay(made.network, distances, start, 0));
      check.input("a random network with its distances",
                  {{"start", static_cast<double>(start)}, {"goal", static_cast<double>(goal)}});
      isWay(check, "wayDown", made.network, way, start, goal, distances[start]);
    }
  });
}

// <hidden>
void unseenMaps(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Rng& rng = check.rng();
    CellMap map = randomMap(rng, 12 + rng.index(12), 12 + rng.index(12));
    const MapCell goal = randomFreeCell(map, rng);
    if (i % 4 == 3) enclose(map, goal, 3);
    wavesAgree(check, student, map, goal);
    const Network network = student.cellNetwork(map);
    check.near("number of lists of arcs of cellNetwork", static_cast<double>(network.size()),
               static_cast<double>(map.blocked.size()), 0);
    const std::vector<double> distances = distancesOn(map, goal, Connectivity::kEightWithRoom);
    std::size_t here = 0;
    const std::size_t end = map.placeOf(goal);
    distancesAgree(check, networkOf(map), student.dijkstra.orInfinite()(network, end), distances, end, here);
    const std::size_t start = map.placeOf(randomFreeCell(map, rng));
    isWay(check, "wayDown", network, student.wayDown(network, distances, start), start, map.placeOf(goal),
          distances[start]);
  });
}
// </hidden>

// Part 3.

void potentials(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Rng& rng = check.rng();
    const Yard yard = i == 0 ? trapYard() : randomYard(rng, {8, 6}, 1 + i, 0.5);
    const Eigen::Vector2d goal = randomFreePlace(yard, rng);
    const FieldGains gains = randomGains(rng);
    for (int place = 0; place < 20; ++place)
      potentialFits(check, student, yard, goal, gains, randomFreePlace(yard, rng));
    const Eigen::Vector2d inside = (yard.blocks.front().lower + yard.blocks.front().upper) / 2;
    describe(check, yard, goal, gains, inside);
    check.that("fieldPotential is infinite in a block",
               student.fieldPotential.orInfinite()(yard, goal, gains, inside) ==
                   std::numeric_limits<double>::infinity());
  });
}

// Differences over 2e-5 m are accurate to a few 1e-10 / d^2 of the push of a block at the distance d, far
// below 1e-4. Every fourth point is nearer to a block than 0.1 m, where the push is large.
// Where d is the reach, the gradient has a kink: points within 1e-4 m of that are left out.
void gradients(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Rng& rng = check.rng();
    const Yard yard = i == 0 ? trapYard() : randomYard(rng, {8, 6}, 1 + i, 0.5);
    const Eigen::Vector2d goal = randomFreePlace(yard, rng);
    const FieldGains gains = randomGains(rng);
    for (int place = 0; place < 20;) {
      const Eigen::Vector2d p = randomFreePlace(yard, rng);
      const bool isPlain = std::all_of(yard.blocks.begin(), yard.blocks.end(), [&](const Block& block) {
        const double apart = (p - nearestPoint(block, p)).norm();
        return apart > 0.02 && std::abs(apart - gains.reach) > 1e-4;
      });
      if (!isPlain || (place % 4 == 0 && isClear(yard, p, 0.1))) continue;
      gradientFits(check, student, yard, goal, gains, p);
      ++place;
    }
  });
}

void slidesInTheTrap(Check& check, Student& student) {
  const FieldGains gains{1, 0.1, 0.8};
  check.input("trapYard() of maps.h, from (1, 3) into the trap");
  std::size_t points = slides(check, student, {trapYard(), kTrapGoal, gains, {1, 3}}, Ending::kStuck);
  check.input("trapYard() of maps.h, from (1, 5.7) past the trap");
  points += slides(check, student, {trapYard(), kTrapGoal, gains, {1, 5.7}}, Ending::kAtGoal);
  check.input("a yard without blocks");
  points += slides(check, student, {{{5, 5}, {}}, {1, 1}, gains, {4, 4.5}}, Ending::kAtGoal);
  check.record("points of slideDown in three descents", static_cast<double>(points));
}

// <hidden>
// Half of the cases are cut off from the goal, half are easy; isCutOff() and isEasy() say what that means.
void slidesAnywhere(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    if (i % 2 == 0)
      slides(check, student, randomTrap(check.rng()), Ending::kStuck);
    else
      slides(check, student, randomPass(check.rng()), Ending::kAtGoal);
  });
}
// </hidden>

// Part 4.

// Whether the straight way from a to b is free, if that is beyond doubt; returns what it is.
Straight straightFits(Check& check, Student& student, const Yard& yard, const Eigen::Vector2d& a,
                      const Eigen::Vector2d& b, double resolution) {
  const bool isOpen = isFree(yard, a) && isFree(yard, b);
  const Straight way = isOpen ? judged(yard, a, b, resolution) : Straight::kBlocked;
  if (way == Straight::kEither) return way;
  check.input(
      "a straight way",
      {{"a", a}, {"b", b}, {"resolution", resolution}, {"blocks, from x, y to x, y", cornersOf(yard)}});
  const auto shown = check.show([&] { return straightSeen(yard, a, b, way); });
  const auto between = check.ask("Are points between the ends tested, no more than `resolution` apart?",
                                 way == Straight::kBlocked && isOpen);
  const auto ends = check.ask("Are both ends tested, too?", !isOpen);
  const auto shorter =
      check.ask("How many points does a way shorter than `resolution` have? At least its ends.",
                way == Straight::kFree && (b - a).norm() < resolution);
  const bool got = student.straightIsFree(yard, a, b, resolution);
  check.that(way == Straight::kFree ? "straightIsFree returns true, since no block is in the way"
                                    : "straightIsFree returns false, since a block is in the way",
             got == (way == Straight::kFree));
  return way;
}

Straight straightFits(Check& check, Student& student, const Yard& yard, double resolution) {
  const Eigen::Vector2d a = randomFreePlace(yard, check.rng()), b = randomFreePlace(yard, check.rng());
  return straightFits(check, student, yard, a, b, resolution);
}

// A wall 6 cm thick, across which ways lead at any angle, or into which they lead by a millimetre; then
// random yards, and short ways.
void straightWays(Check& check, Student& student) {
  const Yard thin{{4, 4}, {{{1.97, 0}, {2.03, 3}}}};
  for (int blocked = 0; blocked < 20;)
    blocked += straightFits(check, student, thin, 0.05) == Straight::kBlocked ? 1 : 0;
  for (int i = 0; i < 8; ++i) {
    Rng& rng = check.rng();
    const Eigen::Vector2d out(rng.uniform(0.2, 1.9), rng.uniform(0.5, 2.5)), in(1.971, out.y() + 0.3);
    straightFits(check, student, thin, i % 2 == 0 ? out : in, i % 2 == 0 ? in : out, 0.05);
  }
  for (int i = 0; i < 40; ++i) {
    const Yard yard = randomYard(check.rng(), {4, 4}, 6, 0.2);
    straightFits(check, student, yard, check.rng().uniform(0.01, 0.1));
    const Eigen::Vector2d a = randomFreePlace(yard, check.rng());
    straightFits(check, student, yard, a, a + Eigen::Vector2d(0, 0.004 * (i % 2)), 0.01);
  }
}

std::vector<Eigen::Vector2d> randomNodes(const Yard& yard, int count, Rng& rng) {
  std::vector<Eigen::Vector2d> nodes;
  for (int i = 0; i < count; ++i) nodes.push_back(randomFreePlace(yard, rng));
  return nodes;
}

void roadmaps(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) {
    Rng& rng = check.rng();
    const Yard yard = i == 0 ? slotYard(1.8, 0.4) : randomYard(rng, {6, 6}, 8, 0.5);
    const int k = 3 + rng.index(6);
    check.input(fmt::format("{}, 50 nodes, k = {}", i == 0 ? "slotYard() of maps.h" : "a random yard", k));
    const std::vector<Eigen::Vector2d> nodes = randomNodes(yard, 50, rng);
    const Network got = student.joinNearest(yard, nodes, k, 0.05);
    ArcEnds here;
    const auto shown = check.show([&] {
      return networkSeen(planOf("The roadmap", yard.size, yard.blocks), nodes, got,
                         roadmapOf(yard, nodes, k, 0.05, Straight::kEither),
                         roadmapOf(yard, nodes, k, 0.05, Straight::kFree), here);
    });
    isRoadmap(check, yard, nodes, k, 0.05, got, here);
  });
}

// The node nearest to the start lies behind a block: over it there is no way, and over the second nearest one
// there is.
void queriesBehindABlock(Check& check, Student& student) {
  const Yard yard = slotYard(1.8, 0.4);
  const std::vector<Eigen::Vector2d> nodes{{1.3, 0.9}, {1.9, 2}, {4.1, 2}};
  Network network(nodes.size());
  for (const std::size_t to : {0u, 2u}) {
    const double length = (nodes[1] - nodes[to]).norm();
    network[1].push_back({to, length});
    network[to].push_back({1, length});
  }
  const auto tested = check.ask("Are the straight ways from start and goal to the nodes tested?");
  for (const int k : {1, 2}) {
    check.input(
        fmt::format("slotYard(1.8, 0.4) of maps.h, the node nearest to the start behind a block, k = {}", k));
    const auto way = student.queryRoadmap(yard, nodes, network, kSlotStart, kSlotGoal, k, 0.05);
    check.near("number of points in the way of queryRoadmap", static_cast<double>(way.size()), k == 1 ? 0 : 4,
               0);
  }
}

// Four nodes in and before the slot, two of them side by side: the way leads over the better one. Without the
// arcs to the slot there is none.
void queriesInTheSlotYard(Check& check, Student& student) {
  const Yard yard = slotYard(1.8, 0.4);
  const std::vector<Eigen::Vector2d> nodes{{1.6, 2}, {3, 2.15}, {3, 2.01}, {4.4, 2}};
  const auto joined = [&](const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    Network network(nodes.size());
    for (const auto& [a, b] : pairs) {
      network[a].push_back({b, (nodes[a] - nodes[b]).norm()});
      network[b].push_back({a, (nodes[a] - nodes[b]).norm()});
    }
    return network;
  };
  check.input("slotYard(1.8, 0.4) of maps.h, a node on each side of the slot, two in it, k = 1");
  const auto way = student.queryRoadmap(yard, nodes, joined({{0, 1}, {0, 2}, {1, 3}, {2, 3}}), kSlotStart,
                                        kSlotGoal, 1, 0.05);
  const Points wanted{kSlotStart, nodes[0], nodes[2], nodes[3], kSlotGoal};
  {
    const auto shown = check.show([&] {
      Figure figure = planOf("A path over the roadmap", yard.size, yard.blocks);
      addLine(figure, way, grading::gotCurve("got"));
      addLine(figure, wanted, grading::wantedCurve("wanted"));
      addLine(figure, nodes, dots("nodes", kBlack, 1.5));
      return grading::Evidence{.figures = {figure}};
    });
    check.near("number of points in the way of queryRoadmap", static_cast<double>(way.size()), 5, 0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      check.near(fmt::format("point {} in the way of queryRoadmap", i), way[i], wanted[i], 0, "m");
  }
  check.input("the same, with no arc that leaves the slot to the right");
  check.that(
      "the way of queryRoadmap is empty if there is none",
      student.queryRoadmap(yard, nodes, joined({{0, 1}, {0, 2}}), kSlotStart, kSlotGoal, 1, 0.05).empty());
  queriesBehindABlock(check, student);
}

// <hidden>
// The length of the shortest way when both ends are joined to their k nearest nodes.
double lengthOver(const Yard& yard, std::vector<Eigen::Vector2d> nodes, Network network,
                  const std::array<Eigen::Vector2d, 2>& ends, int k, Straight with) {
  const std::vector<Eigen::Vector2d> old = nodes;
  for (const Eigen::Vector2d& end : ends) {
    network.emplace_back();
    for (const std::size_t i : nearestTo(old, end, k, old.size())) {
      const Straight way = judged(yard, end, old[i], 0.05);
      if (way != Straight::kFree && way != with) continue;
      network.back().push_back({i, (end - old[i]).norm()});
      network[i].push_back({network.size() - 1, (end - old[i]).norm()});
    }
  }
  return slowDistances(network, old.size())[old.size() + 1];
}

// A query between two random positions, over a roadmap of 60 nodes. Straight ways for which either answer
// is accepted leave a range: the shortest way is at most as long as without all of these, and at least as
// long as with them.
void queryFits(Check& check, Student& student, const Yard& yard) {
  Rng& rng = check.rng();
  const std::vector<Eigen::Vector2d> nodes = randomNodes(yard, 60, rng);
  const std::array<Eigen::Vector2d, 2> ends{randomFreePlace(yard, rng), randomFreePlace(yard, rng)};
  const Network roadmap = roadmapOf(yard, nodes, 6, 0.05, Straight::kFree);
  const auto way = student.queryRoadmap(yard, nodes, roadmap, ends[0], ends[1], 6, 0.05);
  const double least = lengthOver(yard, nodes, roadmap, ends, 6, Straight::kEither),
               most = lengthOver(yard, nodes, roadmap, ends, 6, Straight::kFree);
  if (way.empty()) return check.that("queryRoadmap finds a way where there is one", !std::isfinite(most));
  check.that("queryRoadmap finds a way only where there is one", std::isfinite(least));
  check.near("first point in the way of queryRoadmap", way.front(), ends[0], 0, "m");
  check.near("last point in the way of queryRoadmap", way.back(), ends[1], 0, "m");
  double length = 0;
  for (std::size_t leg = 1; leg < way.size(); ++leg) {
    length += (way[leg] - way[leg - 1]).norm();
    check.that("every leg in the way of queryRoadmap is free",
               judged(yard, way[leg - 1], way[leg], 0.05) != Straight::kBlocked);
  }
  check.atLeast("length of the way of queryRoadmap", length, least - 1e-9, "m");
  if (std::isfinite(most)) check.atMost("length of the way of queryRoadmap", length, most + 1e-9, "m");
}

void queries(Check& check, Student& student) {
  check.forEachCase(9, [&](int i) {
    Rng& rng = check.rng();
    if (i == 8) return queriesBehindABlock(check, student);
    queryFits(check, student, i < 2 ? slotYard(rng.uniform(0.5, 3), 0.4) : randomYard(rng, {6, 6}, 8, 0.5));
  });
}
// </hidden>

// <hidden>
bool isSolved(const Yard& yard, Samples nodes) {
  const std::size_t start = nodes.size();
  nodes.push_back(kSlotStart);
  nodes.push_back(kSlotGoal);
  return std::isfinite(slowDistances(roadmapOf(yard, nodes, 8, 0.05, Straight::kFree), start)[start + 1]);
}

// The rate at which 40 nodes, half of them uniform, join start and goal, over 1000 draws from both pools.
double rateOf(const Yard& yard, const Samples& uniform, const Samples& others, Rng& rng) {
  double solved = 0;
  for (int run = 0; run < 1000; ++run) {
    Samples nodes;
    for (const Samples* pool : {&uniform, &others})
      for (int i = 0; i < 20; ++i)
        nodes.push_back((*pool)[static_cast<std::size_t>(rng.index(static_cast<int>(pool->size())))]);
    solved += isSolved(yard, nodes) ? 1 : 0;
  }
  return solved / 1000;
}

Samples uniformNodes(const Yard& yard, int count, Rng& rng) {
  Samples nodes;
  while (std::ssize(nodes) < count) {
    const Eigen::Vector2d q(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
    if (isFree(yard, q)) nodes.push_back(q);
  }
  return nodes;
}

// Over 60 seeds, 14 % of the draws are solved with uniform nodes. Gaussian nodes raise this rate by 0.13
// with a standard deviation of 0.028, bridges by 0.57 with one of 0.063. The slot holds 10.7 % of the
// Gaussian nodes, with a standard deviation of 0.7 %, and 2.6 % of the uniform ones.
void narrowPassages(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  gaussianFits(check, student, given);
  bridgesFit(check, student, given);
  const double low = check.rng().uniform(1.3, 2.1);
  const Yard yard = slotYard(low, 0.2);
  const Samples uniform = gathered(check, given, yard, 3000, 8000, kUniform,
                                   [&](const auto& rng) { return student.uniformSample(yard, rng); });
  const Samples gaussian = gathered(check, given, yard, 2000, 16000, kGaussian,
                                    [&](const auto& rng) { return student.gaussianSample(yard, 0.2, rng); });
  const Samples bridge = gathered(check, given, yard, 100, 30000, kBridge,
                                  [&](const auto& rng) { return student.bridgeSample(yard, 0.3, rng); });
  check.atLeast("number of nodes of uniformSample from 8000 attempts", static_cast<double>(uniform.size()),
                3000);
  check.atLeast("number of nodes of gaussianSample from 16000 attempts", static_cast<double>(gaussian.size()),
                2000);
  check.atLeast("number of nodes of bridgeSample from 30000 attempts", static_cast<double>(bridge.size()),
                60);
  check.atLeast("share of the nodes of gaussianSample in the slot",
                share(gaussian, {{2, low}, {4, low + 0.2}}), 0.06);
  // Not those of the student's: the worse they were, the easier the others would gain.
  const Samples own = uniformNodes(yard, 3000, check.rng());
  const double usual = rateOf(yard, own, own, check.rng());
  const auto gain = [&](const Samples& others) { return rateOf(yard, own, others, check.rng()) - usual; };
  check.atLeast("rate of success with Gaussian nodes, minus that with uniform ones", gain(gaussian), 0.01);
  check.atLeast("rate of success with bridge nodes, minus that with uniform ones", gain(bridge), 0.25);
}
// </hidden>

// Part 5.

void estimates(Check& check, Student& student) {
  Rng& rng = check.rng();
  const CellMap map = mapOf(std::vector<std::string>(20, std::string(25, '.')));
  for (int i = 0; i < 10; ++i) {
    const MapCell to = randomFreeCell(map, rng);
    const std::vector<double> distances = distancesOn(map, to, Connectivity::kEightWithRoom);
    for (int j = 0; j < 20; ++j) {
      const MapCell from = j == 0 ? to : randomFreeCell(map, rng);
      check.input("two cells",
                  {{"from", Eigen::Vector2d(from.x, from.y)}, {"to", Eigen::Vector2d(to.x, to.y)}});
      check.near("emptyMapDistance", student.emptyMapDistance(from, to), distances[map.placeOf(from)], 1e-9,
                 "m");
    }
  }
}

// Returns the number of nodes that aStar asks for. Distances are those from the start; 1e-9 allows for
// rounding, and for nodes on ways as short as the one returned.
std::size_t searches(Check& check, Student& student, const Network& network, std::size_t start,
                     std::size_t goal, const std::vector<double>& estimates,
                     const std::vector<double>& distances, const CellMap* map = nullptr) {
  std::vector<bool> isAsked(network.size());
  std::vector<std::size_t> way, asked, tooFar;
  std::vector<double> reached;
  const auto shown = check.show([&] {
    if (map == nullptr) return grading::Evidence{};
    std::vector<std::size_t> wanted = steepestWay(network, distances, goal);
    return searchSeen(*map, way, asked, tooFar, wanted);
  });
  const std::string input = check.input();
  const auto arcsOf = [&](std::size_t node) {
    check.that("aStar asks for arcs only of nodes of the network", node < network.size());
    const double through = distances[node] + estimates[node];
    const bool isNeeded = through <= distances[goal] + 1e-9;
    (isNeeded ? asked : tooFar).push_back(node);
    reached.push_back(distances[node]);
    const std::string name =
        map == nullptr ? fmt::format("node {}", node) : "cell " + nameOf(map->cellAt(node));
    check.input(input + ", arcs asked for: " + name);
    check.that("aStar asks for the arcs of no node twice", !isAsked[node]);
    isAsked[node] = true;
    const auto dijkstra = check.ask(
        "Is the estimate of the node left out of the order of the queue, as in Dijkstra's algorithm?",
        !isNeeded && std::is_sorted(reached.begin(), reached.end()));
    if (std::isfinite(through) && std::isfinite(distances[goal]))
      check.atMost("length of the way to a node asked for by aStar, plus its estimate", through,
                   distances[goal] + 1e-9, "m");
    check.that("aStar asks for arcs only where the shortest path could lead", isNeeded);
    return network[node];
  };
  way = student.aStar(arcsOf, start, goal, estimates);
  check.input(input);
  isWay(check, "aStar", network, way, start, goal, distances[goal]);
  return asked.size();
}

std::size_t searchesMap(Check& check, Student& student, const CellMap& map, MapCell start, MapCell goal) {
  const Network network = networkOf(map);
  std::vector<double> estimates(network.size());
  for (std::size_t place = 0; place < network.size(); ++place) {
    const MapCell at = map.cellAt(place);
    const int dx = std::abs(at.x - goal.x), dy = std::abs(at.y - goal.y);
    // Less by a little, for lengths of ways are rounded: else an arc might change it by more than its length.
    estimates[place] = (1 - 1e-12) * (std::numbers::sqrt2 * std::min(dx, dy) + std::abs(dx - dy));
  }
  return searches(check, student, network, map.placeOf(start), map.placeOf(goal), estimates,
                  distancesOn(map, start, Connectivity::kEightWithRoom), &map);
}

void searchesKnownMaps(Check& check, Student& student) {
  check.input("a map without obstacles");
  std::size_t nodes =
      searchesMap(check, student, mapOf(std::vector<std::string>(9, std::string(12, '.'))), {2, 2}, {10, 5});
  check.input("roomMap() of maps.h");
  nodes += searchesMap(check, student, roomMap(), kRoomStart, kRoomGoal);
  check.input("hookMap() of maps.h, with the goal in a closed room");
  CellMap map = hookMap();
  enclose(map, kHookGoal, 1);
  searchesMap(check, student, map, kHookStart, kHookGoal);
  check.input("from a cell to itself");
  searchesMap(check, student, map, kHookStart, kHookStart);
  check.record("cells whose arcs aStar asks for, in two maps with a path", static_cast<double>(nodes));
}

// <hidden>
void searchesAnything(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    if (i < 5) {
      const CellMap map = randomMap(rng, 20, 20);
      searchesMap(check, student, map, randomFreeCell(map, rng), randomFreeCell(map, rng));
      return;
    }
    const RandomNetwork made = randomNetwork(rng, 100, 0.2, 0.3);
    const auto start = static_cast<std::size_t>(rng.index(100)),
               goal = static_cast<std::size_t>(rng.index(100));
    std::vector<double> estimates;
    for (const Eigen::Vector2d& place : made.places) estimates.push_back((place - made.places[goal]).norm());
    searches(check, student, made.network, start, goal, estimates, slowDistances(made.network, start));
  });
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"bug-known-maps", "bug", "around obstacles, back to the line, to the goal", 1, Group::kVisible,
       bugsOnKnownMaps},
      {"bug-rooms", "bug", "where no way leads, the bug says so", 1, Group::kVisible, bugsAndRooms},
      // <hidden>
      {"bug-any-map", "bug", "unseen maps", 1, Group::kHidden, bugsAnywhere},
      // </hidden>
      {"grid-wave", "grid", "the numbers of the wavefront", 1, Group::kVisible, wavesOnKnownMaps},
      {"grid-network", "grid", "a map as a network", 1, Group::kVisible, networksOfMaps},
      {"grid-dijkstra", "grid", "distances on networks", 1, Group::kVisible, distancesOnNetworks},
      {"grid-way", "grid", "the way down", 1, Group::kVisible, waysDown},
      // <hidden>
      {"grid-any-map", "grid", "unseen maps", 1, Group::kHidden, unseenMaps},
      // </hidden>
      {"field-potential", "field", "the potential", 1, Group::kVisible, potentials},
      {"field-gradient", "field", "its gradient", 1, Group::kVisible, gradients},
      {"field-slide", "field", "into the trap, and past it", 1, Group::kVisible, slidesInTheTrap},
      // <hidden>
      {"field-any-yard", "field", "stuck or not in unseen yards", 1, Group::kHidden, slidesAnywhere},
      // </hidden>
      {"prm-straight", "prm", "the local planner", 1, Group::kVisible, straightWays},
      {"prm-join", "prm", "the roadmap", 1, Group::kVisible, roadmaps},
      {"prm-slot", "prm", "ways over a roadmap with a slot (no points)", 0, Group::kVisible,
       queriesInTheSlotYard},
      {"prm-samplers", "prm", "where the nodes are", 1, Group::kVisible, samplers},
      // <hidden>
      {"prm-query", "prm", "ways over a roadmap", 1, Group::kHidden, queries},
      {"prm-passage", "prm", "narrow passages", 1, Group::kHidden, narrowPassages},
      // </hidden>
      {"astar-estimate", "astar", "the estimate", 1, Group::kVisible, estimates},
      {"astar-known-maps", "astar", "shortest paths with few questions", 1, Group::kVisible,
       searchesKnownMaps},
      // <hidden>
      {"astar-anything", "astar", "unseen maps and networks", 1, Group::kHidden, searchesAnything},
      // </hidden>
  };
}
