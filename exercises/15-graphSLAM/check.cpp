#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "base/derivative_check.h"
#include "camera_checks.h"
#include "far_starts.h"
#include "graph_checks.h"
#include "graph_mistakes.h"
#include "interface.h"
#include "map_evidence.h"
#include "scan_checks.h"
#include "scan_mistakes.h"
#include "wrong_loops.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

constexpr double kPi = std::numbers::pi;

// Part 1.

void seesPoses(Check& check, Student& student) {
  for (int i = 0; i < 20; ++i) {
    const double angle = check.rng().uniform(-20, 20);
    wrapsAngle(check, student.wrapped(angle), angle);
  }
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d a = randomPose(check.rng(), 5), b = randomPose(check.rng(), 5);
    seesFrom(check, student.seenFrom(a, b), a, b);
  }
}

// Every other measurement is exact; the others are off by some decimetres, and half a radian.
void errsByWhatIsMeasured(Check& check, Student& student) {
  seesPoses(check, student);
  check.forEachCase(20, [&](int number) {
    Rng& rng = check.rng();
    const Eigen::Vector3d i = randomPose(rng, 5), z = randomPose(rng, 5);
    Eigen::Vector3d e = Eigen::Vector3d::Zero();
    if (number % 2 == 1) e = rng.uniformVector(3, -0.5, 0.5);
    const Eigen::Vector3d j = onward(onward(i, z), e);
    errs(check, student.edgeError(i, j, z), i, j, z, e);
  });
}

// Every fifth error lies where the heading jumps from pi to -pi. Its derivatives do not depend on the heading
// of j, so those with j turned by a quarter are the same.
void differentiates(Check& check, Student& student, int cases, double turns) {
  for (int k = 0; k < cases; ++k) {
    Rng& rng = check.rng();
    const Eigen::Vector3d i = randomPose(rng, 5, turns);
    Eigen::Vector3d j = randomPose(rng, 5, turns);
    const Eigen::Vector3d z = k % 3 == 0 ? relative(i, j) : randomPose(rng, 5, turns);
    if (k % 5 == 4) j[2] = i[2] + z[2] + (k % 2 == 0 ? kPi : -kPi) * (1 - 1e-10);
    const Eigen::Vector3d e = trueError(i, j, z);
    const bool isBorder = std::abs(e[2]) > kPi - 0.3;
    check.input(isBorder          ? "an edge with an error of about half a turn"
                : e.norm() < 1e-9 ? "an edge, measured exactly"
                                  : "an edge",
                {{"i", i}, {"j", j}, {"z", z}});
    const EdgeJacobians got = student.edgeJacobians(i, j, z);
    Eigen::VectorXd x(6);
    x << i, j;
    if (isBorder) x[5] += kPi / 2;
    const Eigen::MatrixXd J = numericJacobian(
        [&](const Eigen::VectorXd& at) { return Eigen::VectorXd(trueError(at.head<3>(), at.tail<3>(), z)); },
        x);
    derivativesFit(check, got, J.leftCols(3), J.rightCols(3), i, z);
  }
}

void differentiatesEdges(Check& check, Student& student) { differentiates(check, student, 30, 1); }

// <hidden>
// Headings with whole turns added, and errors on both sides of half a turn.
void wrapsEverywhere(Check& check, Student& student) {
  differentiates(check, student, 30, 6);
  for (int k = 0; k < 60; ++k) {
    Rng& rng = check.rng();
    const Eigen::Vector3d i = randomPose(rng, 5, 9), z = randomPose(rng, 5, 9);
    const double turn = (rng.index(2) == 0 ? 1 : -1) * (kPi - rng.uniform(0.01, 0.5));
    Eigen::Vector3d j = onward(onward(i, z), {0.3, -0.2, turn});
    j[2] += 2 * kPi * (rng.index(7) - 3);
    errs(check, student.edgeError(i, j, z), i, j, z, {0.3, -0.2, turn});
  }
}
// </hidden>

// Part 2.

// The smallest map, from which the cost can be computed by hand, comes first.
void addsUpCosts(Check& check, Student& student) {
  for (int poses = 2; poses < 10; ++poses) {
    const PoseMap map = randomMap(check.rng(), poses);
    costFits(check, student.mapCost(map), map);
  }
}

std::vector<double> weightsFor(const PoseMap& map, Rng& rng, bool areAny) {
  std::vector<double> weights(map.edges.size(), 1);
  if (areAny)
    for (double& weight : weights) weight = rng.uniform(0.1, 2);
  return weights;
}

void formsEquations(Check& check, Student& student, int poses, bool areWeighted) {
  Rng& rng = check.rng();
  const PoseMap map = randomMap(rng, poses);
  const std::vector<double> weights = weightsFor(map, rng, areWeighted);
  describe(check, map, weights);
  const NormalEquations got = student.normalEquations(map, weights);
  equationsFit(check, fullMatrix(check, got.H, 3 * poses), got.b, map, weights);
}

void formsSmallEquations(Check& check, Student& student) {
  check.forEachCase(6, [&](int number) { formsEquations(check, student, 2 + number, number % 2 == 1); });
}

// Pose 0 is known: what is left has one solution, and a dense solver finds it as well.
void takesSteps(Check& check, Student& student, double damping, bool areWeighted) {
  Rng& rng = check.rng();
  const int poses = 3 + rng.index(8);
  const PoseMap map = randomMap(rng, poses);
  const std::vector<double> weights = weightsFor(map, rng, areWeighted);
  check.input(fmt::format("a random map of {} poses and {} edges, {}", poses, map.edges.size(),
                          areWeighted ? "with weights from 0.1 to 2" : "all weights 1"),
              {{"damping", damping}});
  const Eigen::VectorXd step = student.gaussNewtonStep(map, weights, damping);
  check.shape("step of gaussNewtonStep", step, 3 * poses, 1);
  checkStep(check, step, map, weights, damping);
}

void takesPlainSteps(Check& check, Student& student) {
  check.forEachCase(6, [&](int number) { takesSteps(check, student, number % 2 == 0 ? 0 : 5, number >= 3); });
}

// <hidden>
void formsAnyEquations(Check& check, Student& student) {
  check.forEachCase(6, [&](int number) {
    formsEquations(check, student, 6 + 2 * number, true);
    takesSteps(check, student, number * 3, true);
  });
}
// </hidden>

// Part 3.

void costsFall(Check& check, const PoseMap& map, const Adjusted& got, double least) {
  const auto shown = check.show([&] { return mapSeen(map, got, least); });
  checkPoses(check, "adjusted", got.poses, map.poses);
  check.atLeast("number of costs of adjusted: of the start and of at least one step",
                static_cast<double>(got.costs.size()), 2);
  const double start = trueCost(map);
  check.near("first of the costs of adjusted, that of the start", got.costs.front(), start, 1e-6 * start);
  check.atMost("steps of adjusted", static_cast<double>(got.costs.size()) - 1, 200);
  for (std::size_t k = 1; k < got.costs.size(); ++k) {
    const auto rises = check.ask("Is a step taken although the cost rises? Damp it instead.");
    check.atMost(fmt::format("cost of adjusted after step {}, no more than before", k), got.costs[k],
                 got.costs[k - 1] * (1 + 1e-9));
  }
  const double end = trueCost({got.poses, map.edges});
  check.near("last of the costs of adjusted, that of the poses returned", got.costs.back(), end,
             1e-6 * std::min(end, start));
  const std::string question = questionAboutPoses(map, got, end, least);
  const auto asked = check.ask(question, !question.empty());
  check.atMost("cost of the poses of adjusted", end, least * (1 + 1e-6) + 1e-12);
}

// Two measurements of one motion, with headings that agree: the optimum is a mean weighted by information.
void meetsInTheMiddle(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    check.input("two poses, measured twice: the headings agree, the positions do not; random information");
    Rng& rng = check.rng();
    const double heading = rng.uniform(-3, 3);
    PoseMap map{{randomPose(rng, 2), {}}, {}};
    map.poses[1] =
        onward(map.poses[0], {rng.uniform(-1, 1), rng.uniform(-1, 1), heading + rng.uniform(-1, 1)});
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    Eigen::Vector2d weighted = Eigen::Vector2d::Zero();
    const double c = std::cos(heading), s = std::sin(heading);
    Eigen::Matrix2d R;
    R << c, -s, s, c;
    for (int k = 0; k < 2; ++k) {
      MeasuredEdge edge{0, 1, {rng.uniform(-2, 2), rng.uniform(-2, 2), heading}, Eigen::Matrix3d::Identity()};
      const Eigen::Matrix3d full = randomInformation(rng);
      edge.information.topLeftCorner<2, 2>() = full.topLeftCorner<2, 2>();
      // The information counts along the axes of the measured pose.
      const Eigen::Matrix2d W = R * edge.information.topLeftCorner<2, 2>() * R.transpose();
      sum += W;
      weighted += W * edge.motion.head<2>();
      map.edges.push_back(edge);
    }
    const Eigen::Vector2d middle = solve(sum, weighted);
    const Eigen::Vector3d best = onward(map.poses[0], {middle[0], middle[1], heading});
    costsFall(check, map, student.adjusted(map), trueCost({{map.poses[0], best}, map.edges}));
  });
}

// Returns the number of steps.
std::size_t adjusts(Check& check, Student& student, const PoseMap& map, const PoseMap& fromOdometry) {
  const double least = trueCost({bestPoses(fromOdometry), map.edges});
  const Adjusted got = student.adjusted(map);
  costsFall(check, map, got, least);
  return got.costs.size() - 1;
}

void adjustsStreets(Check& check, Student& student) {
  meetsInTheMiddle(check, student);
  std::size_t steps = 0;
  check.forEachCase(3, [&](int) {
    check.input("a walk of 80 poses along streets, by odometry, with loops where it comes by again");
    const StreetWalk walk = streetWalk(check.rng(), 80, 0.05);
    steps += adjusts(check, student, walk.map, walk.map);
  });
  check.record("steps of adjusted on three walks", static_cast<double>(steps));
}

// <hidden>
// Headings beyond half a turn everywhere, whole turns added to poses and to measurements.
void adjustsThroughTurns(Check& check, Student& student) {
  check.forEachCase(3, [&](int) {
    Rng& rng = check.rng();
    StreetWalk walk = streetWalk(rng, 60, 0.04, {5, -3, 3.1});
    for (std::size_t k = 1; k < walk.map.poses.size(); ++k)
      walk.map.poses[k][2] += 2 * kPi * (rng.index(5) - 2);
    for (MeasuredEdge& edge : walk.map.edges) edge.motion[2] += 2 * kPi * (rng.index(5) - 2);
    adjusts(check, student, walk.map, walk.map);
  });
}

void adjustsFromFarAway(Check& check, Student& student) {
  check.forEachCase(3, [&](int) {
    StreetWalk walk;
    const PoseMap map = mapFarAway(check.rng(), walk);
    check.input("a walk of 50 poses along streets, which start far away; plain steps make the cost rise");
    adjusts(check, student, map, walk.map);
  });
}
// </hidden>

// Part 4.

void findsPartners(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    check.input("two scans of a room, any motion within some decimetres, points up to 0.2 m apart");
    const ScanPair pair = pairOfScans(check.rng());
    const std::vector<int> got = student.partners(pair.reference, pair.moving, pair.guess, 0.2);
    const auto shown = check.show([&] { return partnersSeen(pair, got, 0.2); });
    check.near("number of indices of partners, one for each moving point", static_cast<double>(got.size()),
               static_cast<double>(pair.moving.size()), 0);
    const std::vector<int> wanted = nearestOnes(pair.reference, pointsFrom(pair.guess, pair.moving), 0.2);
    const std::string question = questionAboutPartners(pair, got, 0.2);
    const auto asked = check.ask(question, !question.empty());
    const Eigen::Matrix3d X = frameOf(pair.guess);
    for (std::size_t k = 0; k < got.size(); ++k) {
      const Eigen::Vector3d at = X * Eigen::Vector3d(pair.moving[k].x(), pair.moving[k].y(), 1);
      double nearest = 1e9;
      for (const Eigen::Vector2d& q : pair.reference)
        nearest = std::min(nearest, std::hypot(q.x() - at.x(), q.y() - at.y()));
      check.that("indices of partners are those of points of the reference, or -1",
                 got[k] >= -1 && got[k] < static_cast<int>(pair.reference.size()));
      if (std::abs(nearest - 0.2) < 1e-9) continue;
      check.input(
          "a moving point of two scans, maxDistance = 0.2 m",
          {{"point", pair.moving[k]}, {"motion", pair.guess}, {"distance of the nearest point", nearest}});
      if ((got[k] < 0) != (nearest > 0.2))
        check.near("index by partners (-1: no point is within maxDistance)", got[k], wanted[k], 0);
      if (got[k] < 0) continue;
      const Eigen::Vector2d& q = pair.reference[static_cast<std::size_t>(got[k])];
      check.near("distance of a point from its partner of partners",
                 std::hypot(q.x() - at.x(), q.y() - at.y()), nearest, 1e-9, "m");
    }
  });
}

// With exact points there is no error; with noisy and mirrored ones, no other motion has a smaller one.
void findsBestMotions(Check& check, Student& student) {
  findsPartners(check, student);
  check.forEachCase(12, [&](int number) {
    Rng& rng = check.rng();
    const Eigen::Vector3d motion = randomPose(rng, 3);
    const Eigen::Matrix3d X = frameOf(motion);
    check.input(std::array{"points that were moved exactly", "moved points with noise",
                           "points that were also mirrored"}[static_cast<std::size_t>(number % 3)]);
    Points from;
    Points to;
    for (int k = 0; k < 2 + 4 * number; ++k) {
      from.push_back(rng.uniformVector(2, -3, 3) + Eigen::Vector2d(4, 1));
      const Eigen::Vector2d p =
          number % 3 == 2 ? Eigen::Vector2d(from.back().x(), -from.back().y()) : from.back();
      const Eigen::Vector3d at = X * Eigen::Vector3d(p.x(), p.y(), 1);
      to.emplace_back(at.head<2>());
      if (number % 3 == 1) to.back() += 0.2 * rng.normalVector(2);
    }
    const Eigen::Vector3d got = student.bestMotion(from, to);
    const auto shown = check.show([&] { return motionSeen(from, to, got); });
    check.shape("motion of bestMotion", got, 3, 1);
    const Eigen::Vector3d best = number % 3 == 0 ? motion : bestOf(from, to);
    checkMotion(check, from, to, got, best);
    const double least = squaresOf(from, to, got);
    for (int trial = 0; trial < 60; ++trial) {
      const double radius = trial < 20 ? 1e-3 : trial < 40 ? 0.1 : 3;
      const Eigen::Vector3d other = got + rng.uniformVector(3, -radius, radius);
      check.atMost("sum of squares with bestMotion, no more than with another motion", least,
                   squaresOf(from, to, other) + 1e-9, "m^2");
    }
  });
}

// How well the scans fit, by the motion that was returned. Points near the bound may or may not count after
// one more step.
void fitsAsItSays(Check& check, const ScanPair& pair, const Aligned& got) {
  constexpr double kOverlap = 0.02, kResidual = 0.005;
  const Fit wanted = fitOf(pair, got.motion, 0.3);
  bool isFar = false;
  for (const double reach : {0.4, 0.5, 0.6, 0.8, 1., 1e9}) {
    const Fit other = fitOf(pair, got.motion, reach);
    isFar = isFar || (std::abs(other.residual - got.residual) < kResidual &&
                      std::abs(other.overlap - got.overlap) < kOverlap);
  }
  check.input(fmt::format("{} moving points, {} of the reference", pair.moving.size(), pair.reference.size()),
              {{"motion of aligned", got.motion}});
  const auto far = check.ask("Do partners farther than 0.3 m count for the fit?", isFar);
  const auto count = static_cast<double>(pair.moving.size());
  check.near("overlap of aligned", got.overlap, wanted.overlap, kOverlap,
             {{"Is it the number of points? The overlap is their share.", count * wanted.overlap},
              {"Is the overlap never set?", 0}});
  check.near(
      "residual of aligned", got.residual, wanted.residual, kResidual,
      {{"Is it the mean of the squares? The residual is its root.", wanted.residual * wanted.residual},
       {"Is it the root of the sum, without the mean?", wanted.residual * std::sqrt(wanted.overlap * count)}},
      "m");
}

// The reference, over 1500 pairs: 1.6 cm and 0.008 rad on average, with deviations of 1.2 cm and 0.007 rad;
// 10.4 cm and 0.044 rad at most, and an overlap of 0.82 at least.
void alignsPairs(Check& check, Student& student, int pairs) {
  double way = 0, turn = 0;
  std::vector<double> ways, turns;
  ScanPair pair;
  Aligned got;
  const auto shown = check.show([&] { return scansSeen("The two scans", pair, got.motion, pair.motion); });
  for (int k = 0; k < pairs; ++k) {
    pair = pairOfScans(check.rng());
    got = student.aligned(pair.reference, pair.moving, pair.guess);
    check.shape("motion of aligned", got.motion, 3, 1);
    check.input(fmt::format("pair {} of {} of random rooms", k + 1, pairs), {{"guess", pair.guess}});
    const auto [metres, radians] = missOf(got.motion, pair.motion);
    const std::string question =
        metres > 0.2 || radians > 0.1 ? questionAboutMotion(pair, got.motion) : std::string();
    const auto asked = check.ask(question, !question.empty());
    check.nearAngle("heading of the motion of aligned", got.motion[2], pair.motion[2], 0.1);
    check.near("position of the motion of aligned", got.motion.head<2>(), pair.motion.head<2>(), 0.2, "m");
    check.atMost("distance of the position of aligned from the true one", metres, 0.2, "m");
    ways.push_back(metres);
    turns.push_back(radians);
    way += metres / pairs;
    turn += radians / pairs;
    fitsAsItSays(check, pair, got);
  }
  check.input(fmt::format("{} pairs of scans of random rooms", pairs));
  {
    const auto all =
        check.show([&] { return overPairs("Position", "distance from the true one [m]", ways, 0.04); });
    check.atMost("distance of the position of aligned from the true one, on average", way, 0.04, "m");
  }
  const auto all =
      check.show([&] { return overPairs("Heading", "difference from the true one [rad]", turns, 0.02); });
  check.atMost("difference of the heading of aligned from the true one, on average", turn, 0.02, "rad");
  check.record("distance of aligned from the true position, on average", 100 * way, "cm");
}

void alignsScans(Check& check, Student& student) { alignsPairs(check, student, 20); }

// <hidden>
void alignsMoreScans(Check& check, Student& student) { alignsPairs(check, student, 30); }
// </hidden>

// Part 5.

// The reference finds all of 700 pairs of one place, and takes one pair of 700 strangers for the same.
void tellsPlacesApart(Check& check, Student& student, int pairs) {
  int right = 0, wrong = 0, found = 0;
  std::optional<ScanPair> lost, mixedUp;  // the first of each kind that is judged wrongly
  std::optional<Eigen::Vector3d> gotOfLost, gotOfMixedUp;
  const auto shown = check.show([&] {
    if (right < 0.9 * pairs)
      return scansSeen("A place that is not found again", lost.value(), gotOfLost, lost->motion);
    return scansSeen("Two rooms; wanted: not the same place", mixedUp.value(), gotOfMixedUp, {});
  });
  std::vector<bool> areSame;  // shuffled, so that counting calls does not help
  for (int k = 0; k < 2 * pairs; ++k) areSame.insert(areSame.begin() + check.rng().index(k + 1), k < pairs);
  for (const bool isSame : areSame) {
    const ScanPair pair = isSame ? pairOfScans(check.rng()) : pairOfStrangers(check.rng());
    const auto motion = student.loopMotion(pair.reference, pair.moving, pair.guess);
    if (!isSame) {
      wrong += motion ? 1 : 0;
      if (motion && !mixedUp) {
        mixedUp = pair;
        gotOfMixedUp = motion;
      }
      continue;
    }
    bool isRight = false;
    if (motion) {
      check.shape("motion of loopMotion", *motion, 3, 1);
      const auto [metres, radians] = missOf(*motion, pair.motion);
      isRight = metres < 0.2 && radians < 0.1;
    }
    right += isRight ? 1 : 0;
    found += motion ? 1 : 0;
    if (!isRight && !lost) {
      lost = pair;
      gotOfLost = motion;
    }
  }
  const auto never = check.ask("Is nothing ever taken for the same place?", found + wrong == 0);
  const auto always =
      check.ask("Is every alignment believed? It always returns a motion: look at overlap and residual.",
                found + wrong == 2 * pairs);
  const auto blind = check.ask(
      "Does the answer depend on the scans? Different rooms are taken for one place as often as the same "
      "one.",
      std::abs(found - wrong) < 0.4 * pairs);
  const auto narrow = check.ask("Are the bounds on overlap and residual so narrow that right pairs fail?",
                                found < 0.9 * pairs && wrong <= 0.1 * pairs);
  const auto inexact = check.ask("Are places found, but with motions that are off?",
                                 found >= 0.9 * pairs && right < 0.9 * pairs);
  const auto wide =
      check.ask("Are the bounds on overlap and residual so wide that strangers pass?", wrong > 0.1 * pairs);
  check.atLeast("pairs of one place that loopMotion finds, with the right motion", right, 0.9 * pairs);
  check.atMost("pairs of different rooms that loopMotion takes for one place", wrong, 0.1 * pairs);
}

void tellsRoomsApart(Check& check, Student& student) {
  check.input("40 pairs of scans of one room, and 40 of two different ones");
  tellsPlacesApart(check, student, 40);
}

// <hidden>
void tellsMoreRoomsApart(Check& check, Student& student) { tellsPlacesApart(check, student, 50); }
// </hidden>

// Part 6.

// Some wrong loops cannot be distinguished from right ones: of 200 maps each, the reference repairs 90 % of
// those with a few wrong loops and 86 % of those with many; bounds of 1.5 to 6 m on the distance by
// odometry repair at most 15 %. A small scale from the first step on repairs 71 and 82 % of 120: that will
// do.
void standsOnManyMaps(Check& check, Student& student, double noise, double share) {
  int right = 0;
  JudgedWalk wrong;
  for (int k = 0; k < 12; ++k) {
    const Misled misled = misledWalk(check.rng(), noise, share);
    const Poses got = student.robustlyAdjusted(misled.walk.map);
    checkPoses(check, "robustlyAdjusted", got, misled.walk.map.poses);
    if (apart(got, misled.best) < 0.1)
      ++right;
    else
      wrong = {misled.walk, got, misled.best};
  }
  const auto shown = check.show([&] { return robustSeen(wrong); });
  const std::string question = right < 5 ? questionAboutLoops(wrong) : std::string();
  const auto asked = check.ask(question, !question.empty());
  check.atLeast("maps of robustlyAdjusted, of twelve, that are within 10 cm of those without the wrong loops",
                right, 5);
  check.record("maps, of twelve, that robustlyAdjusted repairs", right, "", Check::Better::kMore);
}

void standsAFew(Check& check, Student& student) {
  check.input("twelve walks of 120 poses along streets; one of ten loops is wrong");
  standsOnManyMaps(check, student, 0.1, 0.1);
}

// <hidden>
void standsMany(Check& check, Student& student) { standsOnManyMaps(check, student, 0.08, 0.28); }
// </hidden>

// Part 7.

void findsCameras(Check& check, Student& student) {
  check.forEachCase(6, [&](int number) {
    projectsExactly(check, student, simulatedView(check.rng(), 6 + number, 0));
    projectsNearly(check, student, simulatedView(check.rng(), 40, 1));
    standsThere(check, student, simulatedView(check.rng(), 6, 0));
  });
}

// The lens of the simulator is so long that the least sum lies in a flat valley: others are kinder to steps
// in numbers of one's own, such as angles and focal lengths.
void refinesCameras(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    errsInPixels(check, student, simulatedView(check.rng(), 6, 1));
    refines(check, student, anyView(check.rng(), 40, 1, 3));
  });
}

// <hidden>
// Other cameras, some from far away, and P of either sign.
void findsAnyCamera(Check& check, Student& student) {
  check.forEachCase(8, [&](int number) {
    Rng& rng = check.rng();
    projectsExactly(check, student, anyView(rng, 6 + number / 2, 0, number % 2 == 0 ? 300 : 3));
    projectsNearly(check, student, anyView(rng, 20 + 5 * number, 1, 3));
    standsThere(check, student, anyView(rng, 6, 0, 3));
    errsInPixels(check, student, anyView(rng, 6 + number, 1, 3));
    refines(check, student, anyView(rng, 20 + 5 * number, 1, 3));
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"error-edges", "error", "Frames, and the error of an edge", 1, Group::kVisible, errsByWhatIsMeasured},
      {"error-derivatives", "error", "Its derivatives", 1, Group::kVisible, differentiatesEdges},
      // <hidden>
      {"error-turns", "error", "Whole turns and half turns", 1, Group::kHidden, wrapsEverywhere},
      // </hidden>
      {"equations-cost", "equations", "The cost of a map", 1, Group::kVisible, addsUpCosts},
      {"equations-normal", "equations", "H and b", 1, Group::kVisible, formsSmallEquations},
      {"equations-step", "equations", "A step that leaves pose 0", 1, Group::kVisible, takesPlainSteps},
      // <hidden>
      {"equations-any", "equations", "Larger maps, weights", 1, Group::kHidden, formsAnyEquations},
      // </hidden>
      {"adjust-streets", "adjust", "Measured twice, and a walk along streets", 1, Group::kVisible,
       adjustsStreets},
      // <hidden>
      {"adjust-turns", "adjust", "Headings beyond half a turn", 1, Group::kHidden, adjustsThroughTurns},
      {"adjust-far", "adjust", "Starts far away", 1, Group::kHidden, adjustsFromFarAway},
      // </hidden>
      {"scan-motion", "scan", "The nearest points, and the best motion for given partners", 1,
       Group::kVisible, findsBestMotions},
      {"scan-align", "scan", "Aligning scans", 1, Group::kVisible, alignsScans},
      // <hidden>
      {"scan-any", "scan", "Rooms that you have not seen", 1, Group::kHidden, alignsMoreScans},
      // </hidden>
      {"loop-rooms", "loop", "The same place or not", 1, Group::kVisible, tellsRoomsApart},
      // <hidden>
      {"loop-any", "loop", "Rooms that you have not seen", 1, Group::kHidden, tellsMoreRoomsApart},
      // </hidden>
      {"robust-few", "robust", "A few wrong loops", 1, Group::kVisible, standsAFew},
      // <hidden>
      {"robust-many", "robust", "Many wrong loops", 1, Group::kHidden, standsMany},
      // </hidden>
      {"camera-linear", "camera", "A camera from what it sees", 1, Group::kVisible, findsCameras},
      {"camera-refined", "camera", "The smallest reprojection errors", 1, Group::kVisible, refinesCameras},
      // <hidden>
      {"camera-any", "camera", "Cameras of any kind", 1, Group::kHidden, findsAnyCamera},
      // </hidden>
  };
}
