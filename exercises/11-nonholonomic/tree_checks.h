#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "car_checks.h"

// Part 2: distances, drives and trees.

inline void distancesFit(rex::grading::Check& check, Student& student) {
  const Eigen::Vector3d a = randomPose(check.rng(), 3), b = randomPose(check.rng(), 3);
  const double dx = a[0] - b[0], dy = a[1] - b[1], plain = a[2] - b[2], angle = wrapped(plain),
               chord = 2 * std::sin(plain / 2);
  {
    const double got = student.poseDistance(a, b), wanted = std::hypot(dx, dy, chord);
    check.input("two poses", {{"a", a}, {"b", b}});
    check.near(
        "poseDistance", got, wanted, 1e-9,
        {{"Is it the angle between the headings? 4:59 a) is the chord.", std::hypot(dx, dy, angle)},
         {"Is it half of the chord? The chord of an angle is 2 sin(angle / 2).",
          std::hypot(dx, dy, chord / 2)},
         {"Are the headings left out?", std::hypot(dx, dy)},
         {"Is the root left out?", wanted * wanted},
         {"Are the distances of position and heading added up?", std::hypot(dx, dy) + std::abs(chord)}});
  }
  const double got = student.angleDistance(a[2], b[2]);
  check.input("two angles", {{"a", a[2]}, {"b", b[2]}});
  check.near(
      "angleDistance", got, std::abs(angle), 1e-9,
      {{"Is it the plain difference, even if that is the long way round?", std::abs(plain)},
       {"Is it the chord, of 4:59 a)?", std::abs(chord)},
       {"Is only one whole turn taken away?", std::abs(std::abs(plain) - 2 * kPi)},
       {"Is only one whole turn taken away?", std::min(std::abs(plain), std::abs(2 * kPi - std::abs(plain)))},
       {"Is the sign of the difference left in?", angle},
       {"Is the sign of the difference left in?", -angle}},
      "rad");
}

/// How near a pose is: by poseDistance(), by the positions only, and by the plain difference of headings.
using Nearness = std::array<double, 3>;
inline Nearness nearnessOf(const Eigen::Vector3d& q, const Eigen::Vector3d& target) {
  const Eigen::Vector3d d = q - target;
  return {std::hypot(d[0], d[1], 2 * std::sin(d[2] / 2)), std::hypot(d[0], d[1]), d.norm()};
}

/// Of the random controls whose way is free, the share that lead nearer to the target. Nothing if fewer than
/// half of them are free.
inline std::optional<Nearness> rankOf(rex::Rng& rng, const CarModel& car, const Eigen::Vector3d& from,
                                      const Eigen::Vector3d& target, double seconds,
                                      const std::vector<Block>& blocks, const Nearness& reached) {
  int free = 0;
  Nearness nearer{};
  for (int i = 0; i < 200; ++i) {
    const Drive drive{2. * rng.index(2) - 1, rng.uniform(car.minSteering, car.maxSteering), seconds};
    bool isFree = true;
    for (int k = 1; k <= 10 && isFree; ++k)
      isFree = !touches(grown(car, 0.1), exact(car, from, drive, 0.1 * k), blocks);
    if (!isFree) continue;
    ++free;
    const Nearness here = nearnessOf(exact(car, from, drive), target);
    for (std::size_t m = 0; m < 3; ++m) nearer[m] += here[m] < reached[m] ? 1 : 0;
  }
  if (free < 100) return {};
  for (double& share : nearer) share /= free;
  return nearer;
}

/// The best of 20 has a rank of 1 / 21 on average, the best of n one of 1 / (n + 1); if some ways are
/// blocked, n is smaller. Over 30 seeds, 20 draws have 0.062 with a standard deviation of 0.0044, and 12
/// draws 0.105 with one of 0.0073.
inline void shareFits(rex::grading::Check& check, Nearness shares, int count, const std::string& targets) {
  constexpr double kMost = 0.085;
  for (double& share : shares) share /= std::max(1, count);
  check.atLeast("number of " + targets + " by which the drives of driveTowards can be judged", count, 60);
  std::string question;
  if (shares[1] <= kMost)
    question = "Is it the nearest by its position only? The heading counts, too: poseDistance().";
  else if (shares[2] <= kMost)
    question = "Is it the nearest by the plain difference of headings? poseDistance() knows whole turns.";
  else if (shares[0] > 0.8)
    question = "Is it the drive that leads farthest away?";
  else if (shares[0] > 0.35)
    question = "Is it any drive that is free, and not the one that leads nearest?";
  else if (shares[0] < 0.2)
    question = fmt::format("Are fewer than 20 controls drawn? It looks like the best of {:.0f}.",
                           20 * 0.062 / shares[0]);
  const auto asked = check.ask(question);
  check.atMost("share of random controls that lead nearer than driveTowards, on average over " + targets,
               shares[0], kMost);
}

/// The drives of two calls with one generator; each draws its own controls.
inline void drivesDiffer(rex::grading::Check& check, Student& student) {
  const CarModel car;
  const Eigen::Vector3d from = randomPose(check.rng(), 5), target = moved(from, {6, 3, 1});
  check.input("two calls with one rng, and nothing in the way", {{"from", from}, {"target", target}});
  const auto [first, second] = student.drivesOfTwo(car, from, target, 2, {}, check.split(98));
  check.that("driveTowards returns a drive, since nothing is in the way", first && second);
  const auto copy = check.ask("Does driveTowards draw from a copy of rng? Pass rng by reference.");
  check.that("driveTowards draws other controls when it is called again with the same rng",
             first->steering != second->steering);
}

inline void drivesFit(rex::grading::Check& check, Student& student) {
  rex::Rng& rng = check.rng();
  std::array<Nearness, 2> sums{};
  std::array<int, 2> counts{};
  for (int i = 0; i < 650; ++i) {
    const std::size_t isNear = i < 450 ? 0 : 1;  // there the heading decides
    const CarModel car = i % 3 == 0 ? randomCar(rng) : CarModel{};
    const double seconds = i % 2 == 0 ? 1 : 7;
    const Eigen::Vector3d from = randomPose(rng, 5), target = moved(from, randomPose(rng, isNear ? 1.5 : 12));
    const double side = rng.index(2) == 0 ? -1 : 1;
    const std::vector<Block> blocks{
        {moved(from, {side > 0 ? car.front + 1.2 : -car.back - 1.2, rng.uniform(-2, 2), kPi / 2}), 6, 0.15},
        {moved(from, {rng.uniform(-4, 4), rng.uniform(2, 3), 0}), 0.15, 0.15}};
    if (touches(grown(car, 0.1), from, blocks)) continue;
    auto drive = student.driveTowards(car, from, target, seconds, blocks, check.split(i));
    if (!drive)  // 20 controls are all blocked once in a million times
      drive = student.driveTowards(car, from, target, seconds, blocks, check.split(2000 + i));
    rex::Rng own = rng.split(static_cast<std::uint64_t>(1000 + i));
    check.input("a wall and a post beside the car",
                {{"L, front, back, width", Eigen::Vector4d(car.wheelbase, car.front, car.back, car.width)},
                 {"from", from},
                 {"target", target},
                 {"seconds", seconds},
                 {"blocks: x, y, heading, length, width", numbersOf(blocks)}});
    if (!drive) {
      check.that("driveTowards returns a drive, since half of all controls are free",
                 !rankOf(own, car, from, target, seconds, blocks, {}));
      continue;
    }
    const auto shown = check.show([&] { return driveSeen(car, from, target, *drive, blocks); });
    checkLimits(check, car, *drive, "the drive of driveTowards");
    check.near("seconds of the drive of driveTowards", drive->seconds, seconds, 1e-9, "s");
    isFreeAlong(check, car, from, *drive, blocks, "the drive of driveTowards");
    const Nearness reached = nearnessOf(exact(car, from, *drive), target);
    const auto rank = rankOf(own, car, from, target, seconds, blocks, reached);
    if (!rank || (!isNear && reached[1] < 2)) continue;
    for (std::size_t m = 0; m < 3; ++m) sums[isNear][m] += (*rank)[m];
    ++counts[isNear];
  }
  check.input(
      "random targets, drives of 1 s, or of 7 s, longer than the car; a wall and a post are in the way");
  shareFits(check, sums[0], counts[0], "targets up to 17 m away");
  shareFits(check, sums[1], counts[1], "targets up to 2 m away");
  check.input("a block of 9 m x 9 m that the car stands in");
  check.that(
      "driveTowards returns nothing, since all ways are blocked",
      !student.driveTowards({}, {0, 0, 0}, {9, 0, 0}, 1.5, {{{2, 0, 0}, 9, 9}}, check.split(99)).has_value());
  drivesDiffer(check, student);
}

/// A room of 24 m x 16 m: two walls that leave a gap of 4 m at one end at least, something small between
/// them, and a start and a goal on the far sides.
inline World randomRoom(rex::Rng& rng) {
  const CarModel larger = grown({}, 0.7);
  while (true) {
    World world{.start = {3.5, rng.uniform(3, 13), rng.uniform(-0.6, 0.6)},
                .goal = {20, rng.uniform(4, 12), rng.uniform(-1.6, 1.6)},
                .blocks = {},
                .lower = {0, 0},
                .upper = {24, 16}};
    for (const double x : {8.5, 15.5})
      world.blocks.push_back({{x, rng.uniform(2, 14), rng.uniform(1, 2)}, rng.uniform(2, 7), 0.6});
    world.blocks.push_back({{12, rng.uniform(1, 15), rng.uniform(-3, 3)}, rng.uniform(0.5, 1.5), 1});
    fence(world);
    if (!touches(larger, world.start, world.blocks) && !touches(larger, world.goal, world.blocks))
      return world;
  }
}

/// How far nodes are from where their controls lead, summed up along the path from the start to a node.
inline rex::grading::Evidence offsetsSeen(const std::vector<CarNode>& tree, const std::vector<double>& slid,
                                          std::size_t node) {
  rex::Series sum = rex::grading::gotCurve("got");
  for (std::size_t i = node; i > 0; i = static_cast<std::size_t>(tree[i].parent)) sum.y.push_back(slid[i]);
  sum.y.push_back(0);
  std::reverse(sum.y.begin(), sum.y.end());
  const double end = static_cast<double>(sum.y.size()) - 1;
  rex::Figure figure{
      .title = "Nodes beside where their controls lead",
      .xLabel = "number of nodes from the start",
      .yLabel = "sum of the distances [m, rad]",
      .series = {sum, rex::grading::wrongPoint("node " + std::to_string(node), end, slid[node])}};
  figure.horizontalLines = {{.at = 0.2, .label = "wanted: at most"}};
  return {.figures = {figure}};
}

/// The errors of poses are summed along each way, so that no car can slide sideways in many tiny steps: 1 mm
/// and 1 mrad for each metre make 0.2 after 200 m.
inline void treeReaches(rex::grading::Check& check, Student& student, const CarModel& car,
                        const World& world) {
  const std::string room = check.input();
  const std::vector<CarNode> tree = student.growTree(car, world, check.split(7));
  {
    const auto start = check.ask("Is the tree only its start?", tree.size() == 1);
    check.atLeast("number of nodes of growTree", static_cast<double>(tree.size()), 2);
  }
  check.near("pose of node 0 of growTree", tree[0].q, world.start, 1e-9, "m, rad");
  std::size_t looked = 0;
  const auto shown = check.show([&] { return treeSeen(car, world, tree, looked); });
  std::vector<double> slid(tree.size(), 0);
  for (std::size_t i = 1; i < tree.size(); ++i) {
    const CarNode& node = tree[i];
    const std::string name = fmt::format("node {} of growTree", i);
    check.atLeast("parent of " + name, node.parent, 0);
    check.atMost("parent of " + name, node.parent, static_cast<double>(i) - 1);
    looked = i;
    const auto parent = static_cast<std::size_t>(node.parent);
    const Eigen::Vector3d from = tree[parent].q, end = exact(car, from, node.by);
    check.input(room, {{"L", car.wheelbase},
                       {"pose of the parent", from},
                       {"speed, steering, seconds", numbersOf(node.by)},
                       {"pose of the node", node.q}});
    checkLimits(check, car, node.by, name);
    check.atMost("seconds of " + name, node.by.seconds, 10, "s");
    check.shape("pose of " + name, node.q, 3, 1);
    const double way = std::abs(node.by.speed) * node.by.seconds;
    check.near("position of " + name + ", where its controls lead", node.q.head<2>(), end.head<2>(),
               2e-3 * way + 1e-6, "m");
    check.nearAngle("heading of " + name + ", where its controls lead", node.q[2], end[2], 2e-3 * way + 1e-6);
    slid[i] = slid[parent] + std::max({std::abs(node.q[0] - end[0]), std::abs(node.q[1] - end[1]),
                                       std::abs(wrapped(node.q[2] - end[2]))});
    {
      const auto summed = check.show([&] { return offsetsSeen(tree, slid, i); });
      const auto beside =
          check.ask("Do nodes lie slightly beside where their controls lead, again and again?");
      check.atMost("how far nodes of growTree are from where their controls lead, summed up from the start",
                   slid[i], 0.2, "m, rad");
    }
    isFreeAlong(check, car, from, node.by, world.blocks, "the edge to " + name);
  }
  check.input(room, {{"pose of the last node", tree.back().q}, {"goal", world.goal}});
  check.atMost("poseDistance of the last node of growTree from the goal",
               nearnessOf(tree.back().q, world.goal)[0], 0.6 + 1e-6);
}
