#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "car_evidence.h"
#include "interface.h"
#include "lots.h"
#include "overlaps.h"
#include "planning/car.h"
#include "planning/dubins.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

double wrapped(double angle) { return std::remainder(angle, 2 * kPi); }

// Where a drive leads according to the library, which has no limits here.
Eigen::Vector3d exact(const CarModel& car, const Eigen::Vector3d& q, const Drive& drive, double share = 1) {
  return driveCar({car.wheelbase, 1.5}, q, {drive.speed, drive.steering}, share * drive.seconds);
}

CarModel randomCar(Rng& rng) {
  CarModel car;
  car.wheelbase = rng.uniform(2.2, 3.2);
  car.maxSteering = rng.uniform(0.45, 0.65);
  car.minSteering = -car.maxSteering;
  car.back = rng.uniform(0.5, 1);
  car.front = car.wheelbase + rng.uniform(0.5, 1);
  car.width = rng.uniform(1.5, 1.9);
  return car;
}

Eigen::Vector3d randomPose(Rng& rng, double reach) {
  return {rng.uniform(-reach, reach), rng.uniform(-reach, reach), rng.uniform(-10, 10)};
}

void checkLimits(Check& check, const CarModel& car, const Drive& drive) {
  check.atMost("speed, forward or backward", std::abs(drive.speed), 1 + 1e-9, "m/s");
  check.atMost("steering angle", drive.steering, car.maxSteering + 1e-9, "rad");
  check.atLeast("steering angle", drive.steering, car.minSteering - 1e-9, "rad");
  check.that("drives last from 0 to 200 s", drive.seconds >= 0 && drive.seconds <= 200);
}

// Every 4 cm of the way: corners then move by 6 cm at most, and 5 cm are tolerated.
void isFreeAlong(Check& check, const CarModel& car, const Eigen::Vector3d& from, const Drive& drive,
                 const std::vector<Block>& blocks) {
  const CarModel smaller = grown(car, -0.05);
  const int tests = std::max(1, static_cast<int>(std::ceil(std::abs(drive.speed) * drive.seconds / 0.04)));
  bool isFree = true;
  for (int i = 0; i <= tests && isFree; ++i)
    isFree = !touches(smaller, exact(car, from, drive, 1. * i / tests), blocks);
  check.that("the body of the car touches nothing on its way", isFree);
}

// Part 1.

void moves(Check& check, Student& student, const CarModel& car, double mostSpeed) {
  Rng& rng = check.rng();
  const Eigen::Vector3d q = randomPose(rng, 10);
  const double speed = rng.uniform(0.3, mostSpeed) * (rng.index(2) == 0 ? -1 : 1);
  const double steering = rng.uniform(car.minSteering, car.maxSteering);
  const Eigen::Vector3d v = student.velocityOf(car, q, speed, steering);
  check.near("velocity", v, carVelocity({car.wheelbase, 1.5}, q, {speed, steering}), 1e-9, "m/s, rad/s");
  for (const double angle : {steering, 0., 1e-9}) {
    const Drive drive{speed, angle, rng.uniform(0.5, 8)};
    const double way = std::abs(speed) * drive.seconds;
    const Eigen::Vector3d end = student.driven(car, q, drive);
    const auto shown = check.show([&] {
      return endsSeen(car, q, end, wayOf(car, q, {{speed, angle, drive.seconds}}, {}).poses);
    });
    check.near("position of the car after the drive", end.head<2>(), exact(car, q, drive).head<2>(),
               1e-3 * way + 1e-9, "m");
    check.near("its heading, up to whole turns", wrapped(end[2] - exact(car, q, drive)[2]), 0,
               1e-3 * way + 1e-9, "rad");
  }
}

void carMoves(Check& check, Student& student) {
  check.input("the usual car, random controls, up to 8 s; then with a steering angle of 0, and of 1e-9");
  check.forEachCase(10, [&](int) { moves(check, student, {}, 2); });
}

// <hidden>
void anyCarMoves(Check& check, Student& student) {
  check.forEachCase(20, [&](int) { moves(check, student, randomCar(check.rng()), 5); });
}
// </hidden>

// Continues with arcs from the last pose, until there are 13 poses.
void driveOn(Rng& rng, const CarModel& car, Poses& path) {
  while (path.size() < 13) {
    const double way = (rng.index(2) == 0 ? -1 : 1) * rng.uniform(0.3, 1.9);
    const double limit = std::min(0.99, std::atan(0.59 * car.wheelbase / std::abs(way)) / car.maxSteering);
    const double steering = rng.uniform(limit * car.minSteering, limit * car.maxSteering);
    path.push_back(exact(car, path.back(), {way, steering, 1}));
    path.back()[2] += 2 * kPi * (rng.index(3) - 1);
  }
}

// Breaks a path between two of its poses: by a shift to the side, a turn on the spot, an arc that is too
// tight, or an arc to the right for a car that turns left only. More arcs follow from wherever the break
// leads.
void breakPath(Rng& rng, const CarModel& car, Poses& path, std::size_t at, int how) {
  const Eigen::Vector3d& before = path[at - 1];
  const double sign = rng.index(2) == 0 ? -1 : 1;
  Eigen::Vector3d wrong = before;
  if (how == 0) wrong = moved(before, {1, sign * rng.uniform(0.012, 0.2), 0});
  if (how == 1) wrong[2] += sign * rng.uniform(0.1, 0.5);
  if (how == 2) wrong = exact(car, before, {1, sign * (1.1 * car.maxSteering), 1});
  if (how == 3) wrong = moved(before, {0, sign * rng.uniform(0.012, 0.2), 0});
  if (how == 4) wrong = exact(car, before, {sign, -rng.uniform(0.2, 0.5), 1});
  path.resize(at);
  path.push_back(wrong);
  driveOn(rng, car, path);
}

// The error that poses come with.
Poses measured(Rng& rng, Poses path) {
  for (Eigen::Vector3d& q : path) q += rng.uniformVector(3, -1e-6, 1e-6);
  return path;
}

// Whether and how a path is broken is random, so that counting calls does not help.
void followsTrajectories(Check& check, Student& student) {
  for (int i = 0; i < 100; ++i) {
    Rng& rng = check.rng();
    const bool follows = rng.index(2) == 0;
    const int how = rng.index(5);
    CarModel car;
    if (how == 0 || how == 4) car.minSteering = 0;
    Poses path{randomPose(rng, 5)};
    driveOn(rng, car, path);
    const std::size_t broken = follows ? 0 : static_cast<std::size_t>(1 + rng.index(12));
    if (!follows) breakPath(rng, car, path, broken, how);
    const std::string wanted = follows ? "wanted: it can be followed" : "wanted: it cannot be followed";
    const auto shown = check.show([&] { return pathSeen(wanted, car, path, broken); });
    check.input(
        follows ? "twelve arcs, driven forward and backward"
                : std::array{
                      "a shift to the side at one pose", "a turn on the spot at one pose",
                      "one arc that is too tight", "a pure shift to the side at one pose",
                      "one arc to the right, for a car that turns left only"}[static_cast<std::size_t>(how)]);
    const bool got = student.canFollow(car, measured(rng, path));
    if (follows)
      check.that("a path of arcs can be followed", got);
    else
      check.that("a path that breaks the constraint, or a limit, cannot be followed", !got);
  }
}

// Part 2.

void distances(Check& check, Student& student) {
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d a = randomPose(check.rng(), 3), b = randomPose(check.rng(), 3);
    check.input("two random poses, headings from -10 to 10 rad");
    const Eigen::Vector4d A(a[0], a[1], std::cos(a[2]), std::sin(a[2])),
        B(b[0], b[1], std::cos(b[2]), std::sin(b[2]));
    check.near("distance of two poses", student.poseDistance(a, b), (A - B).norm(), 1e-9);
    check.input("two random angles from -10 to 10 rad");
    // The angle between the two directions, from their cosine and sine.
    const double angle = std::atan2(A[2] * B[3] - A[3] * B[2], A[2] * B[2] + A[3] * B[3]);
    check.near("distance of two angles", student.angleDistance(a[2], b[2]), std::abs(angle), 1e-9, "rad");
  }
}

// Large and small blocks and long walls: some lie within the car, some across it with no corner of one
// inside of the other. Whether the car is free is random, and never decided by less than a centimetre.
void findsOverlaps(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 200; ++i) {
    const bool isTouched = rng.index(2) == 0;
    const int count = !isTouched && rng.index(10) == 0 ? 0 : 1 + rng.index(2);
    CarModel car;
    Eigen::Vector3d q;
    std::vector<Block> blocks;
    do {
      car = randomCar(rng);
      q = randomPose(rng, 3);
      blocks.clear();
      for (int k = 0; k < count; ++k)
        blocks.push_back(
            {randomPose(rng, 5), std::exp(rng.uniform(-1.6, 2)), std::exp(rng.uniform(-1.6, 1))});
    } while (touches(car, q, blocks) != isTouched || touches(grown(car, 0.01), q, blocks) != isTouched ||
             touches(grown(car, -0.01), q, blocks) != isTouched);
    check.input(std::string("a random car that touches ") + (isTouched ? "some" : "none") + " of " +
                std::to_string(count) + " random blocks");
    const auto shown = check.show(
        [&] { return placeSeen(isTouched ? "wanted: not free" : "wanted: free", car, q, blocks); });
    check.that("whether the car is free", student.isFree(car, q, blocks) == !isTouched);
  }
}

// Of the random controls whose way is free, the share that lead nearer to the target. Nothing if fewer than
// half of them are free.
std::optional<double> rankOf(Rng& rng, const CarModel& car, const Eigen::Vector3d& from,
                             const Eigen::Vector3d& target, double seconds, const std::vector<Block>& blocks,
                             double reached) {
  int free = 0, nearer = 0;
  for (int i = 0; i < 200; ++i) {
    const Drive drive{2. * rng.index(2) - 1, rng.uniform(car.minSteering, car.maxSteering), seconds};
    bool isFree = true;
    for (int k = 1; k <= 10 && isFree; ++k)
      isFree = !touches(grown(car, 0.1), exact(car, from, drive, 0.1 * k), blocks);
    if (!isFree) continue;
    ++free;
    const Eigen::Vector3d end = exact(car, from, drive), d = end - target;
    if (std::hypot(d[0], d[1], 2 * std::sin(d[2] / 2)) < reached) ++nearer;
  }
  if (free < 100) return {};
  return 1. * nearer / free;
}

// The best of 20 has a rank of 1 / 21 on average, the best of n one of 1 / (n + 1); if some ways are
// blocked, n is smaller. Over 30 seeds, 20 draws have 0.062 with a standard deviation of 0.0044, and 12
// draws 0.105 with one of 0.0073.
void drivesTowards(Check& check, Student& student) {
  check.input(
      "450 random targets, drives of 1 s, or of 7 s, longer than the car; a wall and a post are in the way");
  Rng& rng = check.rng();
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 450; ++i) {
    const CarModel car = i % 3 == 0 ? randomCar(rng) : CarModel{};
    const double seconds = i % 2 == 0 ? 1 : 7;
    const Eigen::Vector3d from = randomPose(rng, 5), target = moved(from, randomPose(rng, 12));
    const double side = rng.index(2) == 0 ? -1 : 1;
    const std::vector<Block> blocks{
        {moved(from, {side > 0 ? car.front + 1.2 : -car.back - 1.2, rng.uniform(-2, 2), kPi / 2}), 6, 0.15},
        {moved(from, {rng.uniform(-4, 4), rng.uniform(2, 3), 0}), 0.15, 0.15}};
    if (touches(grown(car, 0.1), from, blocks)) continue;
    Rng given = rng.split(static_cast<std::uint64_t>(i));
    const auto drive = student.driveTowards(car, from, target, seconds, blocks, given);
    Rng own = rng.split(static_cast<std::uint64_t>(1000 + i));
    if (!drive) {
      check.that("a drive is returned if half of all controls are free",
                 !rankOf(own, car, from, target, seconds, blocks, 1e9));
      continue;
    }
    const auto shown = check.show([&] { return driveSeen(car, from, target, *drive, blocks); });
    checkLimits(check, car, *drive);
    check.near("duration of the drive", drive->seconds, seconds, 1e-9, "s");
    isFreeAlong(check, car, from, *drive, blocks);
    const Eigen::Vector3d d = exact(car, from, *drive) - target;
    const auto rank =
        rankOf(own, car, from, target, seconds, blocks, std::hypot(d[0], d[1], 2 * std::sin(d[2] / 2)));
    if (!rank || d.head<2>().norm() < 2) continue;
    sum += *rank;
    ++count;
  }
  check.atLeast("number of targets by which the drives can be judged", count, 120);
  check.atMost("share of random controls that lead nearer to the target, on average",
               sum / std::max(1, count), 0.085);
  check.input("a block that the car stands in");
  Rng given = rng.split(99);
  check.that("no drive is returned if all ways are blocked",
             !student.driveTowards({}, {0, 0, 0}, {9, 0, 0}, 1.5, {{{2, 0, 0}, 9, 9}}, given).has_value());
}

// A room of 24 m x 16 m: two walls that leave a gap of 4 m at one end at least, something small between them,
// and a start and a goal on the far sides.
World room(Rng& rng) {
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

// The errors of poses are summed along each way, so that no car can slide sideways in many tiny steps: 1 mm
// and 1 mrad for each metre make 0.2 after 200 m.
void treeReaches(Check& check, Student& student, const CarModel& car, const World& world) {
  Rng given = check.rng().split(7);
  const std::vector<CarNode> tree = student.growTree(car, world, given);
  check.atLeast("number of nodes", static_cast<double>(tree.size()), 2);
  check.near("pose of the first node", tree[0].q, world.start, 1e-9, "m, rad");
  std::size_t looked = 0;
  const auto shown = check.show([&] { return treeSeen(car, world, tree, looked); });
  std::vector<double> slid(tree.size(), 0);
  for (std::size_t i = 1; i < tree.size(); ++i) {
    const CarNode& node = tree[i];
    check.that("parents come before their children",
               node.parent >= 0 && static_cast<std::size_t>(node.parent) < i);
    looked = i;
    checkLimits(check, car, node.by);
    check.atMost("duration of an edge", node.by.seconds, 10, "s");
    check.shape("pose of a node", node.q, 3, 1);
    const auto parent = static_cast<std::size_t>(node.parent);
    const Eigen::Vector3d from = tree[parent].q, end = exact(car, from, node.by);
    const double way = std::abs(node.by.speed) * node.by.seconds;
    const Eigen::Vector3d off(node.q[0] - end[0], node.q[1] - end[1], wrapped(node.q[2] - end[2]));
    check.near("error of a node's pose, from its parent and its controls", off, Eigen::Vector3d::Zero(),
               2e-3 * way + 1e-6, "m, rad");
    slid[i] = slid[parent] + off.cwiseAbs().maxCoeff();
    check.atMost("sum of the pose errors on the way from the start to a node", slid[i], 0.2, "m, rad");
    isFreeAlong(check, car, from, node.by, world.blocks);
  }
  const Eigen::Vector3d d = tree.back().q - world.goal;
  check.atMost("distance of the last node from the goal", std::hypot(d[0], d[1], 2 * std::sin(d[2] / 2)),
               0.6 + 1e-6);
}

void treeInARoom(Check& check, Student& student) {
  check.input("a room of 24 m x 16 m with three things in it");
  treeReaches(check, student, {}, room(check.rng()));
}

// <hidden>
void treeAnywhere(Check& check, Student& student) {
  check.forEachCase(4, [&](int) {
    CarModel car;
    car.wheelbase = check.rng().uniform(2.2, 2.8);
    treeReaches(check, student, car, placed(room(check.rng()), anywhere(check.rng())));
  });
}
// </hidden>

// Part 3.

const std::array<std::string, 6> kNames{"LSL", "LSR", "RSL", "RSR", "LRL", "RLR"};

// Where the pieces lead. The steering angle of a car with a wheelbase of 1 makes the radius.
Eigen::Vector3d endOf(const std::string& word, const std::array<double, 3>& lengths, Eigen::Vector3d q,
                      double radius) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double steering = word[i] == 'S' ? 0 : std::atan(1 / radius) * (word[i] == 'L' ? 1 : -1);
    q = driveCar({1, 1.57}, q, {1, steering}, lengths[i]);
  }
  return q;
}

// Between the centres of the first and the last circle.
double gapOf(const std::string& word, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const auto center = [&](const Eigen::Vector3d& q, char side) {
    return moved(q, {0, side == 'L' ? radius : -radius, 0}).head<2>().eval();
  };
  return (center(to, word[2]) - center(from, word[0])).norm();
}

// Poses along the pieces, every fiftieth of each.
Poses piecesOf(const std::string& word, const std::array<double, 3>& lengths, const Eigen::Vector3d& from,
               double radius) {
  Poses poses{from};
  std::array<double, 3> driven{};
  for (std::size_t i = 0; i < 3; ++i)
    for (int part = 1; part <= 50; ++part) {
      driven[i] = lengths[i] * part / 50;
      poses.push_back(endOf(word, driven, from, radius));
    }
  return poses;
}

void checkPieces(Check& check, const std::string& word, const std::array<double, 3>& lengths,
                 const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius) {
  const auto shown = check.show([&] {
    return dubinsSeen(word + " from start to goal", piecesOf(word, lengths, from, radius), from, to, radius,
                      false);
  });
  for (std::size_t i = 0; i < 3; ++i) {
    check.atLeast("length of a piece", lengths[i], 0, "m");
    if (word[i] != 'S') check.atMost("length of an arc", lengths[i], 2 * kPi * radius + 1e-6, "m");
    check.atMost("length of a piece", lengths[i], 1000 * radius, "m");
  }
  if (word[1] != 'S') check.atLeast("length of the middle arc", lengths[1], kPi * radius - 1e-6, "m");
  const Eigen::Vector3d end = endOf(word, lengths, from, radius);
  check.near("position at the end of the pieces", end.head<2>(), to.head<2>(), 1e-5, "m");
  check.near("heading at the end, up to whole turns", wrapped(end[2] - to[2]), 0, 1e-5, "rad");
}

void wordsLead(Check& check, Student& student) {
  check.forEachCase(6, [&](int k) {
    const auto word = static_cast<DubinsWord>(k);
    const std::string& name = kNames[static_cast<std::size_t>(k)];
    for (int i = 0; i < 30; ++i) {
      Rng& rng = check.rng();
      const double radius = rng.uniform(0.5, 5);
      const Eigen::Vector3d from = randomPose(rng, 10);
      Eigen::Vector3d to = randomPose(rng, i % 2 == 0 ? 4 * radius : radius);
      to.head<2>() += from.head<2>();
      const double gap = gapOf(name, from, to, radius) / radius;
      const bool crosses = name[1] == 'S' && name[0] != name[2], turns = name[1] != 'S';
      if ((crosses && std::abs(gap - 2) < 1e-3) || (turns && std::abs(gap - 4) < 1e-3)) continue;
      const bool exists = crosses ? gap > 2 : turns ? gap < 4 : true;
      check.input(name + " between two random poses");
      const auto lengths = student.dubinsLengths(word, from, to, radius);
      check.that(exists ? "the word leads there" : "the word does not lead there",
                 lengths.has_value() == exists);
      if (lengths) checkPieces(check, name, *lengths, from, to, radius);
    }
  });
}

void isShortest(Check& check, Student& student, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                double radius) {
  const DubinsWay way = student.shortestDubins(from, to, radius);
  const auto word = static_cast<std::size_t>(way.word);
  check.that("the word is one of the six", word < 6);
  checkPieces(check, kNames[word], way.lengths, from, to, radius);
  const auto shown = check.show([&] {
    return dubinsSeen("The shortest of six", piecesOf(kNames[word], way.lengths, from, radius), from, to,
                      radius, true);
  });
  check.near("length of the shortest", way.lengths[0] + way.lengths[1] + way.lengths[2],
             dubinsLength(from, to, radius), 1e-6, "m");
}

void shortestOfSix(Check& check, Student& student) {
  for (int i = 0; i < 60; ++i) {
    Rng& rng = check.rng();
    const double radius = 3.8;
    const Eigen::Vector3d from = randomPose(rng, 10);
    Eigen::Vector3d to = randomPose(rng, i % 2 == 0 ? 15 : 4);
    to.head<2>() += from.head<2>();
    check.input("two random poses, and a radius of 3.8 m");
    isShortest(check, student, from, to, radius);
  }
}

// <hidden>
void shortestAnywhere(Check& check, Student& student) {
  check.forEachCase(40, [&](int i) {
    Rng& rng = check.rng();
    const double radius = std::exp(rng.uniform(-2, 2));
    const Eigen::Vector3d from = randomPose(rng, 10);
    if (i % 4 == 0) {  // straight on: both arcs vanish
      check.input("a goal straight ahead");
      return isShortest(check, student, from, moved(from, {rng.uniform(1, 9), 0, 0}), radius);
    }
    Eigen::Vector3d to = randomPose(rng, radius * rng.uniform(0.5, 6));
    to.head<2>() += from.head<2>();
    isShortest(check, student, from, to, radius);
  });
}
// </hidden>

// Part 4.

// Uses the grader's motion model, not the student's. The reference needs 65 drives at most.
void parks(Check& check, Student& student, const CarModel& car, const World& lot) {
  const std::vector<Drive> plan = student.park(car, lot);
  const auto shown = check.show([&] { return parkingSeen(car, lot, plan); });
  check.atLeast("number of drives", static_cast<double>(plan.size()), 1);
  check.atMost("number of drives", static_cast<double>(plan.size()), 500);
  double way = 0;
  Eigen::Vector3d q = lot.start;
  for (const Drive& drive : plan) {
    checkLimits(check, car, drive);
    way += std::abs(drive.speed) * drive.seconds;
    check.atMost("length of the whole way", way, 200, "m");
    isFreeAlong(check, car, q, drive, lot.blocks);
    q = exact(car, q, drive);
  }
  check.near("position of the car at the end", q.head<2>(), lot.goal.head<2>(), 0.1, "m");
  check.near("heading at the end, relative to that of the space", wrapped(q[2] - lot.goal[2]), 0, 0.05,
             "rad");
}

CarModel leftOnly() { return {.minSteering = 0}; }

void parksAtTheKerb(Check& check, Student& student) {
  check.input("a space at the kerb, 2.4 m longer than the car; the street is 7 m wide");
  parks(check, student, {}, streetLot(check.rng(), 7, 2.4));
}

void parksTurningLeft(Check& check, Student& student) {
  check.input(
      "a space at the kerb, 3.5 m longer than the car, that turns left only; the street is 10 m wide");
  parks(check, student, leftOnly(), streetLot(check.rng(), 10, 3.5));
}

// <hidden>
void parksAnywhere(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) {
    Rng& rng = check.rng();
    World lot = i < 3 ? streetLot(rng, 7, rng.uniform(1.6, 2.4)) : bayLot(rng, 6.5, i == 3);
    if (i == 1) lot = mirrored(lot);
    parks(check, student, {}, placed(lot, anywhere(rng)));
  });
}

void parksTurningLeftAnywhere(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    Rng& rng = check.rng();
    const World lot = i < 3 ? streetLot(rng, 10, rng.uniform(2.8, 3.6)) : bayLot(rng, 9, false);
    parks(check, student, leftOnly(), placed(lot, anywhere(rng)));
  });
}
// </hidden>

// Part 5.

Eigen::Vector4d rigMotion(const Rig& rig, const Eigen::Vector4d& q, double speed, double steering,
                          double seconds) {
  return driveTrailer({{rig.car.wheelbase, 1.5}, rig.hitchLength}, q, {speed, steering}, seconds);
}

void rigMoves(Check& check, Student& student) {
  for (int i = 0; i < 25; ++i) {
    Rng& rng = check.rng();
    Rig rig;
    rig.car = randomCar(rng);
    rig.hitchLength = rng.uniform(2, 5);
    const Eigen::Vector4d q = rng.uniformVector(4, -3, 3);
    const double speed = rng.uniform(-2, 2), steering = rng.uniform(-0.6, 0.6);
    check.input("a random car, trailer, state and controls");
    const Eigen::Vector4d v = student.rigVelocity(rig, q, speed, steering);
    check.near("velocity of the car", v.head<3>(),
               carVelocity({rig.car.wheelbase, 1.5}, q.head<3>(), {speed, steering}), 1e-9, "m/s, rad/s");
    // The axle is d behind the hitch. It must not slide: its velocity has no part across the trailer.
    const double across = -v[0] * std::sin(q[3]) + v[1] * std::cos(q[3]) - rig.hitchLength * v[3];
    check.near("speed at which the axle of the trailer slides sideways", across, 0, 1e-9, "m/s");
    check.input("wheels straight, an angle of 1e-5 rad at the hitch, one second");
    const double rate = student.hitchGrowth(rig, speed);
    const Eigen::Vector4d later = rigMotion(rig, {0, 0, 0, -1e-5}, speed, 0, 1);
    check.near("logarithm of the growth in a second", rate, std::log((later[2] - later[3]) / 1e-5), 1e-4,
               "1/s");
  }
}

// Over 2000 seeds the reference was never farther off than 2 mm and 1 mrad, and folded up by 0.6 rad at most.
void reverses(Check& check, Student& student, const Rig& rig, int mostTurns) {
  Rng& rng = check.rng();
  const double trailer = rng.uniform(-0.25, 0.25), offset = rng.uniform(-1, 1);
  Eigen::Vector4d q(0, offset + rig.hitchLength * std::sin(trailer), rng.uniform(-0.25, 0.25), trailer);
  for (const int i : {2, 3}) q[i] += 2 * kPi * mostTurns * (rng.index(3) - 1);
  constexpr double kStep = 0.05;
  std::vector<Eigen::Vector4d> states{q};
  const auto shown = check.show([&] { return reversingSeen(rig, states, kStep); });
  for (int step = 0; step < 1000; ++step) {
    const double steering = student.reverseSteering(rig, q);
    checkLimits(check, rig.car, {1, steering, 1});
    q = rigMotion(rig, q, -1, steering, kStep);
    states.push_back(q);
    check.atMost("angle between car and trailer", std::abs(wrapped(q[2] - q[3])), 1.2, "rad");
    if (step < 800) continue;
    check.near("distance of the trailer's axle from the axis", q[1] - rig.hitchLength * std::sin(q[3]), 0,
               0.05, "m");
    check.near("headings of car and trailer, up to whole turns",
               Eigen::Vector2d(wrapped(q[2]), wrapped(q[3])), Eigen::Vector2d::Zero(), 0.05, "rad");
  }
}

void reversesATrailer(Check& check, Student& student) {
  check.input("a hitch of 4 m, up to 1 m beside the axis, headings up to 0.25 rad off it, 50 m backward");
  check.forEachCase(4, [&](int) { reverses(check, student, {}, 0); });
}

// <hidden>
void reversesAnyTrailer(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    Rig rig;
    rig.hitchLength = check.rng().uniform(2.5, 5);
    rig.car = randomCar(check.rng());
    rig.car.wheelbase = check.rng().uniform(2.3, 3);
    rig.car.maxSteering = check.rng().uniform(0.5, 0.65);
    rig.car.minSteering = -rig.car.maxSteering;
    reverses(check, student, rig, 1);
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"car-moves", "car", "Velocity, and where a drive leads", 1, Group::kVisible, carMoves},
      {"car-follows", "car", "Could a car follow this trajectory?", 1, Group::kVisible, followsTrajectories},
      // <hidden>
      {"car-any", "car", "Cars of other sizes", 1, Group::kHidden, anyCarMoves},
      // </hidden>
      {"tree-metrics", "tree", "Distances of poses and of angles", 1, Group::kVisible, distances},
      {"tree-overlap", "tree", "Whether the body of a car is free", 1, Group::kVisible, findsOverlaps},
      {"tree-drive", "tree", "One drive towards a target", 1, Group::kVisible, drivesTowards},
      {"tree-room", "tree", "A tree reaches its goal", 1, Group::kVisible, treeInARoom},
      // <hidden>
      {"tree-any", "tree", "Rooms that you have not seen", 2, Group::kHidden, treeAnywhere},
      // </hidden>
      {"dubins-words", "dubins", "The six words, one by one", 2, Group::kVisible, wordsLead},
      {"dubins-shortest", "dubins", "The shortest of them", 1, Group::kVisible, shortestOfSix},
      // <hidden>
      {"dubins-any", "dubins", "Other radii, near and far goals", 1, Group::kHidden, shortestAnywhere},
      // </hidden>
      {"park-kerb", "parking", "A space at the kerb", 1, Group::kVisible, parksAtTheKerb},
      {"park-left", "parking", "Turning left only", 1, Group::kVisible, parksTurningLeft},
      // <hidden>
      {"park-any", "parking", "Spaces that you have not seen", 1, Group::kHidden, parksAnywhere},
      {"park-left-any", "parking", "Turning left only, elsewhere", 1, Group::kHidden,
       parksTurningLeftAnywhere},
      // </hidden>
      {"trailer-moves", "trailer", "How a trailer moves", 1, Group::kVisible, rigMoves},
      {"trailer-reverses", "trailer", "Backward along a line", 1, Group::kVisible, reversesATrailer},
      // <hidden>
      {"trailer-any", "trailer", "Short and long trailers", 1, Group::kHidden, reversesAnyTrailer},
      // </hidden>
  };
}
