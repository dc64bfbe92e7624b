#include "grading/check.h"

#include <cmath>
#include <numbers>
#include <set>

#include "grid_checks.h"
#include "interface.h"
#include "plan_evidence.h"
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
    const MapCell start = randomFreeCell(map, rng), goal = randomFreeCell(map, rng);
    if (i % 4 == 3) enclose(map, goal, 2);
    if (map.isFree(start)) return bugObeys(check, student, map, start, goal);
    bugObeys(check, student, map, randomFreeCell(map, rng), goal);
  });
}
// </hidden>

// Part 2.

void wavesAgree(Check& check, Student& student, const CellMap& map, MapCell goal) {
  const std::vector<int> got = student.waveNumbers(map, goal),
                         wanted = wavefront(gridMapOf(map), {goal.x, goal.y}, Connectivity::kEight);
  const auto shown = check.show([&] { return wavesSeen(map, goal, got, wanted); });
  check.that("there is a number for each cell", got.size() == wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) check.near("number of a cell", got[i], wanted[i], 0);
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

void networkFits(Check& check, Student& student, const CellMap& map) {
  const Network network = student.cellNetwork(map), wanted = networkOf(map);
  const auto shown = check.show([&] {
    Points places;
    for (std::size_t place = 0; place < wanted.size(); ++place) places.push_back(centerOf(map.cellAt(place)));
    return networkSeen(planOf("The map as a network", map), places, network, wanted, wanted);
  });
  check.that("there is a list of arcs for each cell", network.size() == map.blocked.size());
  for (std::size_t place = 0; place < network.size(); ++place) {
    const MapCell at = map.cellAt(place);
    check.near("number of arcs of a cell", static_cast<double>(network[place].size()),
               static_cast<double>(wanted[place].size()), 0);
    std::set<std::size_t> ends;
    for (const auto& [to, length] : network[place]) {
      check.that("arcs lead to cells of the map", to < network.size());
      check.that("no arc is there twice", ends.insert(to).second);
      const MapCell end = map.cellAt(to);
      check.that("arcs lead to free cells that touch", map.isFree(end) && touches(at, end) && !(at == end));
      check.that("no diagonal arc leads past a blocked cell",
                 map.isFree({end.x, at.y}) && map.isFree({at.x, end.y}));
      check.near("length of an arc", length, std::hypot(end.x - at.x, end.y - at.y), 1e-12, "m");
    }
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
    distancesAgree(check, student.dijkstra.orInfinite()(made.network, from),
                   slowDistances(made.network, from));
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
      isWay(check, made.network, way, start, goal, distances[start]);
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
    check.that("there is a list of arcs for each cell", network.size() == map.blocked.size());
    const std::vector<double> distances = distancesOn(map, goal, Connectivity::kEightWithRoom);
    distancesAgree(check, student.dijkstra.orInfinite()(network, map.placeOf(goal)), distances);
    const std::size_t start = map.placeOf(randomFreeCell(map, rng));
    isWay(check, network, student.wayDown(network, distances, start), start, map.placeOf(goal),
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
    check.input(i == 0 ? "trapYard() of maps.h, random gains and positions"
                       : "a random yard, gains and positions");
    for (int place = 0; place < 20; ++place) {
      const Eigen::Vector2d p = randomFreePlace(yard, rng);
      const double U = trueU(yard, goal, gains, p);
      check.near("potential", student.fieldPotential(yard, goal, gains, p), U, 1e-9 * (1 + U), "J");
    }
    const Block& block = yard.blocks.front();
    check.that("the potential is infinite in a block",
               student.fieldPotential.orInfinite()(yard, goal, gains, (block.lower + block.upper) / 2) ==
                   std::numeric_limits<double>::infinity());
  });
}

// Differences over 2e-5 m are accurate to 1e-10 / d^2 of the push of a block 0.1 m away, far below 1e-4.
// Where d is the reach, the gradient has a kink: points within 1e-4 m of that are left out.
void gradients(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Rng& rng = check.rng();
    const Yard yard = i == 0 ? trapYard() : randomYard(rng, {8, 6}, 1 + i, 0.5);
    const Eigen::Vector2d goal = randomFreePlace(yard, rng);
    const FieldGains gains = randomGains(rng);
    check.input(i == 0 ? "trapYard() of maps.h, random gains and positions"
                       : "a random yard, gains and positions");
    for (int place = 0; place < 20;) {
      const Eigen::Vector2d p = randomFreePlace(yard, rng);
      const bool isPlain = std::all_of(yard.blocks.begin(), yard.blocks.end(), [&](const Block& block) {
        const double apart = (p - nearestPoint(block, p)).norm();
        return apart > 0.1 && std::abs(apart - gains.reach) > 1e-4;
      });
      if (!isPlain) continue;
      const Eigen::Vector2d wanted = trueGradient(yard, goal, gains, p);
      check.near("gradient of the potential", student.fieldGradient(yard, goal, gains, p), wanted,
                 1e-4 * (1 + wanted.norm()), "N");
      ++place;
    }
  });
}

void slidesInTheTrap(Check& check, Student& student) {
  const FieldGains gains{1, 0.1, 0.8};
  check.input("trapYard() of maps.h, from (1, 3) into the trap");
  slides(check, student, {trapYard(), kTrapGoal, gains, {1, 3}}, Ending::kStuck);
  check.input("trapYard() of maps.h, from (1, 5.7) past the trap");
  slides(check, student, {trapYard(), kTrapGoal, gains, {1, 5.7}}, Ending::kAtGoal);
  check.input("a yard without blocks");
  slides(check, student, {{{5, 5}, {}}, {1, 1}, gains, {4, 4.5}}, Ending::kAtGoal);
}

// <hidden>
// Half of the cases are cut off from the goal, half are easy; isCutOff() and isEasy() say what that means.
void slidesAnywhere(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    if (i % 2 == 0) return slides(check, student, randomTrap(check.rng()), Ending::kStuck);
    slides(check, student, randomPass(check.rng()), Ending::kAtGoal);
  });
}
// </hidden>

// Part 4.

void straightWays(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.input("a wall 6 cm thick, across which ways lead at any angle; resolution 5 cm");
  const Yard thin{{4, 4}, {{{1.97, 0}, {2.03, 3}}}};
  int blocked = 0;
  while (blocked < 20) {
    const Eigen::Vector2d a = randomFreePlace(thin, rng), b = randomFreePlace(thin, rng);
    const Straight way = judged(thin, a, b, 0.05);
    if (way == Straight::kEither) continue;
    blocked += way == Straight::kBlocked ? 1 : 0;
    const auto shown = check.show([&] { return straightSeen(thin, a, b, way); });
    check.that("whether the straight way is free",
               student.straightIsFree(thin, a, b, 0.05) == (way == Straight::kFree));
  }
  check.input("random yards, resolution 1 to 10 cm");
  for (int i = 0; i < 40; ++i) {
    const Yard yard = randomYard(rng, {4, 4}, 6, 0.2);
    const double resolution = rng.uniform(0.01, 0.1);
    const Eigen::Vector2d a = randomFreePlace(yard, rng), b = randomFreePlace(yard, rng);
    const Straight way = judged(yard, a, b, resolution);
    if (way == Straight::kEither) continue;
    const auto shown = check.show([&] { return straightSeen(yard, a, b, way); });
    check.that("whether the straight way is free",
               student.straightIsFree(yard, a, b, resolution) == (way == Straight::kFree));
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
    check.input(i == 0 ? "slotYard() of maps.h, 50 nodes" : "a random yard, 50 nodes");
    const std::vector<Eigen::Vector2d> nodes = randomNodes(yard, 50, rng);
    const Network got = student.joinNearest(yard, nodes, k, 0.05);
    const auto shown = check.show([&] {
      return networkSeen(planOf("The roadmap", yard.size, yard.blocks), nodes, got,
                         roadmapOf(yard, nodes, k, 0.05, Straight::kEither),
                         roadmapOf(yard, nodes, k, 0.05, Straight::kFree));
    });
    isRoadmap(check, yard, nodes, k, 0.05, got);
  });
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
      Figure figure = planOf("A way over the roadmap", yard.size, yard.blocks);
      addLine(figure, way, grading::gotCurve("got"));
      addLine(figure, wanted, grading::wantedCurve("wanted"));
      addLine(figure, nodes, dots("nodes", kBlack, 1.5));
      return grading::Evidence{.figures = {figure}};
    });
    check.near("number of points of the way", static_cast<double>(way.size()), 5, 0);
    for (std::size_t i = 0; i < wanted.size(); ++i) check.near("point of the way", way[i], wanted[i], 0, "m");
  }
  check.input("the same, with no arc that leaves the slot to the right");
  check.that(
      "the way is empty if there is none",
      student.queryRoadmap(yard, nodes, joined({{0, 1}, {0, 2}}), kSlotStart, kSlotGoal, 1, 0.05).empty());
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
  if (way.empty()) return check.that("a way is found where there is one", !std::isfinite(most));
  check.that("a way is found only where there is one", std::isfinite(least));
  check.near("first point of the way", way.front(), ends[0], 0, "m");
  check.near("last point of the way", way.back(), ends[1], 0, "m");
  double length = 0;
  for (std::size_t leg = 1; leg < way.size(); ++leg) {
    length += (way[leg] - way[leg - 1]).norm();
    check.that("every leg of the way is free",
               judged(yard, way[leg - 1], way[leg], 0.05) != Straight::kBlocked);
  }
  check.atLeast("length of the way", length, least - 1e-9, "m");
  if (std::isfinite(most)) check.atMost("length of the way", length, most + 1e-9, "m");
}

void queries(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Rng& rng = check.rng();
    queryFits(check, student, i < 2 ? slotYard(rng.uniform(0.5, 3), 0.4) : randomYard(rng, {6, 6}, 8, 0.5));
  });
}
// </hidden>

using Samples = std::vector<Eigen::Vector2d>;

// Students' generators come from a stream of their own, one for each check, so that winding one back does
// not reveal what the grader draws.
Rng generatorsOf(Check& check) { return check.rng().split(7); }

// `count` nodes, or as many as that many attempts find; each attempt has random numbers of its own.
template <class Sample>
Samples gathered(Check& check, Rng& given, const Yard& yard, int count, int attempts, const Sample& sample) {
  Samples samples;
  for (int i = 0; i < attempts && std::ssize(samples) < count; ++i) {
    const std::optional<Eigen::Vector2d> q = sample(Rng(given.next()));
    if (!q) continue;
    check.that("every node is free", q->allFinite() && isFree(yard, *q));
    samples.push_back(*q);
  }
  return samples;
}

double share(const Samples& samples, const Block& block) {
  double inside = 0;
  for (const Eigen::Vector2d& q : samples) inside += nearestPoint(block, q) == q ? 1 : 0;
  return inside / static_cast<double>(samples.size());
}

double fromBorder(const Yard& yard, const Eigen::Vector2d& q) {
  return std::min(q.minCoeff(), (yard.size - q).minCoeff());
}

// 300 uniform nodes: half of them lie in each half, up to 6 standard deviations of 0.029.
void uniformFits(Check& check, Student& student, Rng& given) {
  const Yard wall{{4, 4}, {{{0, 0}, {2, 4}}}};
  check.input("a yard of 4 x 4 m whose left half is a block");
  const Samples nodes =
      gathered(check, given, wall, 300, 900, [&](Rng rng) { return student.uniformSample(wall, rng); });
  const auto shown = check.show(
      [&] { return samplesSeen("Uniform nodes; wanted: evenly over the free half", wall, nodes); });
  check.atLeast("number of uniform nodes from 900 attempts", static_cast<double>(nodes.size()), 300);
  check.near("share of uniform nodes in the upper half", share(nodes, {{2, 2}, {4, 4}}), 0.5, 0.17);
  check.near("share of uniform nodes in the right half", share(nodes, {{3, 0}, {4, 4}}), 0.5, 0.17);
}

// Far from the border of the yard, the density at a distance x from the wall is proportional to P(N(0,
// sigma) > x). In sigmas, its mean is sqrt(2 pi) / 4 = 0.627 with a deviation of 0.523, its mean square 2 /
// 3 with one of 1.075, and 11.4 % lie beyond 1.3. Six standard deviations are tolerated.
void gaussianFits(Check& check, Student& student, Rng& given) {
  const double sigma = check.rng().uniform(0.25, 0.3);
  const Yard wall{{12, 4}, {{{0, 0}, {12, 2}}}};
  check.input("a yard of 12 x 4 m whose lower half is a block; sigma = " + std::to_string(sigma) + " m");
  const Samples nodes = gathered(check, given, wall, 12000, 12000,
                                 [&](Rng rng) { return student.gaussianSample(wall, sigma, rng); });
  const auto shown = check.show(
      [&] { return samplesSeen("Gaussian nodes; wanted: near the wall, within some 0.6 m", wall, nodes); });
  double sum = 0, squares = 0, far = 0, count = 0;
  for (const Eigen::Vector2d& q : nodes) {
    if (q.x() < 1.2 || q.x() > 10.8 || q.y() > 3.2) continue;
    const double distance = (q.y() - 2) / sigma;
    sum += distance;
    squares += distance * distance;
    far += distance > 1.3 ? 1 : 0;
    ++count;
  }
  check.atLeast("number of Gaussian nodes at the wall, from 12000 attempts", count, 250);
  const double forgiven = 6 / std::sqrt(count);
  check.near("mean distance of Gaussian nodes from the wall, in sigmas", sum / count, 0.627,
             0.523 * forgiven);
  check.near("mean square of this distance, in sigmas squared", squares / count, 2 / 3., 1.075 * forgiven);
  check.near("share of Gaussian nodes that are more than 1.3 sigmas from the wall", far / count, 0.114,
             0.318 * forgiven);
}

// Blocks everywhere except for three slots of that width: along x, along y, and slanted, as stairs of 10
// cm.
Yard threeSlots(Rng& rng, double width) {
  const double y = rng.uniform(0.6, 1.4), x = rng.uniform(2.6, 3.4);
  Yard yard{{6, 2},
            {{{0, 0}, {2, y - width / 2}},
             {{0, y + width / 2}, {2, 2}},
             {{2, 0}, {x - width / 2, 2}},
             {{x + width / 2, 0}, {4, 2}}}};
  const double slope = rng.uniform(0.6, 0.8) * (rng.index(2) == 0 ? -1 : 1);
  for (int i = 0; i < 20; ++i) {
    const double left = 4 + 0.1 * i, middle = 1 + slope * (left - 4.95),
                 half = std::hypot(1, slope) * width / 2;
    yard.blocks.push_back({{left, 0}, {left + 0.1, middle - half}});
    yard.blocks.push_back({{left, middle + half}, {left + 0.1, 2}});
  }
  return yard;
}

// Over 20 seeds, the reference has shares of 0.33, 0.29 and 0.38, with standard deviations below 0.045.
void bridgesFit(Check& check, Student& student, Rng& given) {
  const double sigma = check.rng().uniform(0.25, 0.35);
  const Yard yard = threeSlots(check.rng(), 2 * sigma / 3);
  check.input("a yard of 6 x 2 m, blocked except for three slots: along x, along y and slanted; sigma = " +
              std::to_string(sigma) + " m");
  const Samples nodes = gathered(check, given, yard, 200, 12000,
                                 [&](Rng rng) { return student.bridgeSample(yard, sigma, rng); });
  const auto shown =
      check.show([&] { return samplesSeen("Bridge nodes; wanted: in all slots", yard, nodes); });
  check.atLeast("number of bridge nodes from 12000 attempts", static_cast<double>(nodes.size()), 150);
  check.atLeast("share of bridge nodes in the slot along x", share(nodes, {{0, 0}, {2, 2}}), 0.14);
  check.atLeast("share of bridge nodes in the slot along y", share(nodes, {{2, 0}, {4, 2}}), 0.14);
  check.atLeast("share of bridge nodes in the slanted slot", share(nodes, {{4, 0}, {6, 2}}), 0.14);
}

void samplers(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  uniformFits(check, student, given);
  gaussianFits(check, student, given);
  bridgesFit(check, student, given);
  // For a node 3.5 sigma away from all blocks, the ends of its bridge would have to be 7 sigma apart.
  const Yard slot = slotYard(1.9, 0.2);
  check.input("slotYard() of maps.h, 0.2 m wide; sigma = 0.3 m");
  const Samples bridge =
      gathered(check, given, slot, 60, 6000, [&](Rng rng) { return student.bridgeSample(slot, 0.3, rng); });
  const auto shown = check.show([&] {
    return samplesSeen("Bridge nodes; wanted: two of five in the slot, none far from blocks", slot, bridge);
  });
  check.atLeast("number of bridge nodes from 6000 attempts", static_cast<double>(bridge.size()), 10);
  for (const Eigen::Vector2d& q : bridge) {
    double distance = fromBorder(slot, q);
    for (const Block& block : slot.blocks) distance = std::min(distance, (q - nearestPoint(block, q)).norm());
    check.atMost("distance of a bridge node from the nearest block", distance, 3.5 * 0.3, "m");
  }
  check.atLeast("share of bridge nodes in the slot", share(bridge, {{2, 1.9}, {4, 2.1}}), 0.4);
}

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

// Over 60 seeds, 14 % of the draws are solved with uniform nodes. Gaussian nodes raise this rate by 0.13
// with a standard deviation of 0.028, bridges by 0.57 with one of 0.063. The slot holds 10.7 % of the
// Gaussian nodes, with a standard deviation of 0.7 %, and 2.6 % of the uniform ones.
void narrowPassages(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  gaussianFits(check, student, given);
  bridgesFit(check, student, given);
  const double low = check.rng().uniform(1.3, 2.1);
  const Yard yard = slotYard(low, 0.2);
  const Samples uniform =
      gathered(check, given, yard, 3000, 8000, [&](Rng rng) { return student.uniformSample(yard, rng); });
  const Samples gaussian = gathered(check, given, yard, 2000, 16000,
                                    [&](Rng rng) { return student.gaussianSample(yard, 0.2, rng); });
  const Samples bridge =
      gathered(check, given, yard, 100, 30000, [&](Rng rng) { return student.bridgeSample(yard, 0.3, rng); });
  check.atLeast("number of uniform nodes from 8000 attempts", static_cast<double>(uniform.size()), 3000);
  check.atLeast("number of Gaussian nodes from 16000 attempts", static_cast<double>(gaussian.size()), 2000);
  check.atLeast("number of bridge nodes from 30000 attempts", static_cast<double>(bridge.size()), 60);
  check.atLeast("share of Gaussian nodes in the slot", share(gaussian, {{2, low}, {4, low + 0.2}}), 0.06);
  const double usual = rateOf(yard, uniform, uniform, check.rng());
  const auto gain = [&](const Samples& others) { return rateOf(yard, uniform, others, check.rng()) - usual; };
  check.atLeast("rate of success with Gaussian nodes, minus that with uniform ones", gain(gaussian), 0.01);
  check.atLeast("rate of success with bridge nodes, minus that with uniform ones", gain(bridge), 0.25);
}
// </hidden>

// Part 5.

void estimates(Check& check, Student& student) {
  Rng& rng = check.rng();
  check.input("random cells of an empty map");
  const CellMap map = mapOf(std::vector<std::string>(20, std::string(25, '.')));
  for (int i = 0; i < 10; ++i) {
    const MapCell to = randomFreeCell(map, rng);
    const std::vector<double> distances = distancesOn(map, to, Connectivity::kEightWithRoom);
    for (int j = 0; j < 20; ++j) {
      const MapCell from = j == 0 ? to : randomFreeCell(map, rng);
      check.near("distance on an empty map", student.emptyMapDistance(from, to), distances[map.placeOf(from)],
                 1e-9, "m");
    }
  }
}

// Distances are those from the start; 1e-9 allows for rounding, and for nodes on ways as short as the one
// returned.
void searches(Check& check, Student& student, const Network& network, std::size_t start, std::size_t goal,
              const std::vector<double>& estimates, const std::vector<double>& distances,
              const CellMap* map = nullptr) {
  std::vector<bool> isAsked(network.size());
  std::vector<std::size_t> way, asked, tooFar;
  const auto shown = check.show([&] {
    if (map == nullptr) return grading::Evidence{};
    std::vector<std::size_t> wanted = steepestWay(network, distances, goal);
    return searchSeen(*map, way, asked, tooFar, wanted);
  });
  const auto arcsOf = [&](std::size_t node) {
    check.that("arcs are asked for nodes of the network", node < network.size());
    const bool isNeeded = distances[node] + estimates[node] <= distances[goal] + 1e-9;
    (isNeeded ? asked : tooFar).push_back(node);
    check.that("arcs are asked for no node twice", !isAsked[node]);
    isAsked[node] = true;
    check.that("arcs are asked only where the shortest way could lead", isNeeded);
    return network[node];
  };
  way = student.aStar(arcsOf, start, goal, estimates);
  isWay(check, network, way, start, goal, distances[goal]);
}

void searchesMap(Check& check, Student& student, const CellMap& map, MapCell start, MapCell goal) {
  const Network network = networkOf(map);
  std::vector<double> estimates(network.size());
  for (std::size_t place = 0; place < network.size(); ++place) {
    const MapCell at = map.cellAt(place);
    const int dx = std::abs(at.x - goal.x), dy = std::abs(at.y - goal.y);
    estimates[place] = std::numbers::sqrt2 * std::min(dx, dy) + std::abs(dx - dy);
  }
  searches(check, student, network, map.placeOf(start), map.placeOf(goal), estimates,
           distancesOn(map, start, Connectivity::kEightWithRoom), &map);
}

void searchesKnownMaps(Check& check, Student& student) {
  check.input("a map without obstacles");
  searchesMap(check, student, mapOf(std::vector<std::string>(9, std::string(12, '.'))), {2, 2}, {10, 5});
  check.input("roomMap() of maps.h");
  searchesMap(check, student, roomMap(), kRoomStart, kRoomGoal);
  check.input("hookMap() of maps.h, with the goal in a closed room");
  CellMap map = hookMap();
  enclose(map, kHookGoal, 1);
  searchesMap(check, student, map, kHookStart, kHookGoal);
  check.input("from a cell to itself");
  searchesMap(check, student, map, kHookStart, kHookStart);
}

// <hidden>
void searchesAnything(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    if (i < 5) {
      const CellMap map = randomMap(rng, 20, 20);
      return searchesMap(check, student, map, randomFreeCell(map, rng), randomFreeCell(map, rng));
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
      {"astar-known-maps", "astar", "shortest ways with few questions", 1, Group::kVisible,
       searchesKnownMaps},
      // <hidden>
      {"astar-anything", "astar", "unseen maps and networks", 1, Group::kHidden, searchesAnything},
      // </hidden>
  };
}
