#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/derivative_check.h"
#include "graph_checks.h"
#include "interface.h"
#include "map_evidence.h"
#include "scan_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

constexpr double kPi = std::numbers::pi;

// Part 1.

void nearPose(Check& check, const std::string& what, const Eigen::Vector3d& got,
              const Eigen::Vector3d& wanted) {
  check.near(what + ": position", got.head<2>(), wanted.head<2>(), 1e-9, "m");
  check.near(what + ": heading", got[2], wanted[2], 1e-9, "rad");
}

void seesPoses(Check& check, Student& student) {
  check.input("angles from -20 to 20 rad");
  for (int i = 0; i < 20; ++i) {
    const double angle = check.rng().uniform(-20, 20), got = student.wrapped(angle);
    check.near("the same direction",
               std::hypot(std::cos(got) - std::cos(angle), std::sin(got) - std::sin(angle)), 0, 1e-9);
    check.atMost("size of a wrapped angle", std::abs(got), kPi + 1e-9, "rad");
  }
  check.input("two random poses");
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d a = randomPose(check.rng(), 5), b = randomPose(check.rng(), 5);
    nearPose(check, "b seen from a", student.seenFrom(a, b), relative(a, b));
  }
}

void errsByWhatIsMeasured(Check& check, Student& student) {
  check.forEachCase(20, [&](int number) {
    Rng& rng = check.rng();
    const Eigen::Vector3d i = randomPose(rng, 5), j = randomPose(rng, 5);
    if (number % 2 == 0) {
      check.input("an exact measurement between two random poses");
      check.near("error", student.edgeError(i, j, relative(i, j)), Eigen::Vector3d::Zero(), 1e-9, "m, rad");
    } else {
      check.input("a measurement that is off by some decimetres, and half a radian");
      const Eigen::Vector3d e = rng.uniformVector(3, -0.5, 0.5);
      nearPose(check, "error", student.edgeError(i, onward(onward(i, j), e), j), e);
    }
  });
}

// Within 0.3 rad of where the heading's error jumps, the numeric derivative would see the jump.
void differentiates(Check& check, Student& student, int cases, double turns) {
  for (int k = 0; k < cases; ++k) {
    Rng& rng = check.rng();
    const Eigen::Vector3d i = randomPose(rng, 5, turns), j = randomPose(rng, 5, turns);
    const Eigen::Vector3d z = k % 3 == 0 ? relative(i, j) : randomPose(rng, 5, turns);
    check.input(k % 3 == 0 ? "random poses, an exact measurement" : "random poses, any measurement");
    const EdgeJacobians got = student.edgeJacobians(i, j, z);
    if (std::abs(trueError(i, j, z)[2]) > kPi - 0.3) continue;
    Eigen::VectorXd x(6);
    x << i, j;
    const Eigen::MatrixXd J = numericJacobian(
        [&](const Eigen::VectorXd& at) { return Eigen::VectorXd(trueError(at.head<3>(), at.tail<3>(), z)); },
        x);
    check.near("derivative by pose i", got.byI, J.leftCols(3), 1e-5);
    check.near("derivative by pose j", got.byJ, J.rightCols(3), 1e-5);
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
    nearPose(check, "error", student.edgeError(i, j, z), {0.3, -0.2, turn});
  }
}
// </hidden>

// Part 2.

void addsUpCosts(Check& check, Student& student) {
  check.forEachCase(8, [&](int number) {
    check.input("a random map, edges in both directions, each with its own information");
    const PoseMap map = randomMap(check.rng(), 2 + number);
    const double wanted = trueCost(map);
    check.near("cost", student.mapCost(map), wanted, 1e-9 * wanted);
  });
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
  const NormalEquations got = student.normalEquations(map, weights);
  const Eigen::VectorXd x = numbersOf(map.poses), r = weightedErrors(map, weights, x);
  const Eigen::MatrixXd J =
      numericJacobian([&](const Eigen::VectorXd& at) { return weightedErrors(map, weights, at); }, x);
  const Eigen::MatrixXd H = J.transpose() * J;
  const Eigen::VectorXd b = J.transpose() * r;
  check.near("H", fullMatrix(check, got.H, 3 * poses), H, 1e-5 * H.norm());
  check.near("b", got.b, b, 1e-5 * b.norm());
}

void formsSmallEquations(Check& check, Student& student) {
  check.input("random maps with edges in both directions, some of them twice; all weights 1");
  check.forEachCase(6, [&](int number) { formsEquations(check, student, 2 + number, false); });
}

// Pose 0 is known: what is left has one solution, and a dense solver finds it as well.
void takesSteps(Check& check, Student& student, double damping, bool areWeighted) {
  Rng& rng = check.rng();
  const int poses = 3 + rng.index(8), unknowns = 3 * poses - 3;
  const PoseMap map = randomMap(rng, poses);
  const std::vector<double> weights = weightsFor(map, rng, areWeighted);
  const Eigen::VectorXd step = student.gaussNewtonStep(map, weights, damping);
  check.shape("step", step, 3 * poses, 1);
  check.near("step of pose 0", step.head(3), Eigen::Vector3d::Zero(), 1e-9);
  const Eigen::VectorXd x = numbersOf(map.poses), r = weightedErrors(map, weights, x);
  const Eigen::MatrixXd J =
      numericJacobian([&](const Eigen::VectorXd& at) { return weightedErrors(map, weights, at); }, x);
  const Eigen::MatrixXd H = J.rightCols(unknowns).transpose() * J.rightCols(unknowns) +
                            damping * Eigen::MatrixXd::Identity(unknowns, unknowns);
  const Eigen::VectorXd wanted = -solve(H, Eigen::VectorXd(J.rightCols(unknowns).transpose() * r));
  check.near("step of the other poses", step.tail(unknowns), wanted, 1e-5 * (1 + wanted.norm()));
}

void takesPlainSteps(Check& check, Student& student) {
  check.input("random maps of 3 to 10 poses; damping 0, then 5");
  check.forEachCase(6, [&](int number) { takesSteps(check, student, number % 2 == 0 ? 0 : 5, false); });
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
  checkPoses(check, got.poses, map.poses);
  check.atLeast("number of costs: of the start and of at least one step",
                static_cast<double>(got.costs.size()), 2);
  const double start = trueCost(map);
  check.near("the first cost, of the start", got.costs.front(), start, 1e-6 * start);
  check.atMost("steps", static_cast<double>(got.costs.size()) - 1, 200);
  for (std::size_t k = 1; k < got.costs.size(); ++k)
    check.atMost("cost after a step, relative to before", got.costs[k], got.costs[k - 1] * (1 + 1e-9));
  const double end = trueCost({got.poses, map.edges});
  check.near("the last cost, of the poses returned", got.costs.back(), end, 1e-6 * end);
  check.atMost("cost of the map", end, least * (1 + 1e-6) + 1e-12);
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

void adjusts(Check& check, Student& student, const PoseMap& map, const PoseMap& fromOdometry) {
  const double least = trueCost({bestPoses(fromOdometry), map.edges});
  costsFall(check, map, student.adjusted(map), least);
}

void adjustsStreets(Check& check, Student& student) {
  check.forEachCase(3, [&](int) {
    check.input("a walk of 80 poses along streets, by odometry, with loops where it comes by again");
    const StreetWalk walk = streetWalk(check.rng(), 80, 0.05);
    adjusts(check, student, walk.map, walk.map);
  });
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
    Rng& rng = check.rng();
    const StreetWalk walk = streetWalk(rng, 50, 0.05);
    PoseMap map = walk.map;
    map.poses = walk.truth;
    for (std::size_t k = 1; k < map.poses.size(); ++k)
      map.poses[k] += Eigen::Vector3d(rng.normal(), rng.normal(), 0.5 * rng.normal());
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
    check.that("one index for each moving point", got.size() == pair.moving.size());
    const Eigen::Matrix3d X = frameOf(pair.guess);
    for (std::size_t k = 0; k < got.size(); ++k) {
      const Eigen::Vector3d at = X * Eigen::Vector3d(pair.moving[k].x(), pair.moving[k].y(), 1);
      double nearest = 1e9;
      for (const Eigen::Vector2d& q : pair.reference)
        nearest = std::min(nearest, std::hypot(q.x() - at.x(), q.y() - at.y()));
      check.that("indices of points of the reference, or -1",
                 got[k] >= -1 && got[k] < static_cast<int>(pair.reference.size()));
      if (std::abs(nearest - 0.2) < 1e-9) continue;
      check.that("-1 where, and only where, no point is within the distance",
                 (got[k] < 0) == (nearest > 0.2));
      if (got[k] < 0) continue;
      const Eigen::Vector2d& q = pair.reference[static_cast<std::size_t>(got[k])];
      check.near("distance of a point from its partner", std::hypot(q.x() - at.x(), q.y() - at.y()), nearest,
                 1e-9, "m");
    }
  });
}

double squaresOf(const Points& from, const Points& to, const Eigen::Vector3d& motion) {
  const Eigen::Matrix3d X = frameOf(motion);
  double sum = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    sum += std::pow(X(0, 0) * from[i].x() + X(0, 1) * from[i].y() + X(0, 2) - to[i].x(), 2) +
           std::pow(X(1, 0) * from[i].x() + X(1, 1) * from[i].y() + X(1, 2) - to[i].y(), 2);
  return sum;
}

// With exact points there is no error; with noisy and mirrored ones, no other motion has a smaller one.
void findsBestMotions(Check& check, Student& student) {
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
    check.shape("motion", got, 3, 1);
    if (number % 3 == 0) {
      check.near("motion: position", got.head<2>(), motion.head<2>(), 1e-6, "m");
      check.near("motion: heading", byTurns(got[2] - motion[2]), 0, 1e-6, "rad");
    }
    const double least = squaresOf(from, to, got);
    for (int trial = 0; trial < 60; ++trial) {
      const double radius = trial < 20 ? 1e-3 : trial < 40 ? 0.1 : 3;
      const Eigen::Vector3d other = got + rng.uniformVector(3, -radius, radius);
      check.atLeast("sum of squares of another motion", squaresOf(from, to, other), least - 1e-9, "m^2");
    }
  });
}

// A motion's error: metres, radians.
std::pair<double, double> missOf(const Eigen::Vector3d& got, const Eigen::Vector3d& wanted) {
  return {std::hypot(got[0] - wanted[0], got[1] - wanted[1]), std::abs(byTurns(got[2] - wanted[2]))};
}

// How well the scans fit, by the motion that was returned. Points near the bound may or may not count after
// one more step.
void fitsAsItSays(Check& check, const ScanPair& pair, const Aligned& got) {
  const Eigen::Matrix3d X = frameOf(got.motion);
  double count = 0, squares = 0;
  for (const Eigen::Vector2d& p : pair.moving) {
    const Eigen::Vector3d at = X * Eigen::Vector3d(p.x(), p.y(), 1);
    double nearest = 1e9;
    for (const Eigen::Vector2d& q : pair.reference)
      nearest = std::min(nearest, std::hypot(q.x() - at.x(), q.y() - at.y()));
    if (nearest > 0.3) continue;
    squares += nearest * nearest;
    ++count;
  }
  check.near("overlap", got.overlap, count / static_cast<double>(pair.moving.size()), 0.02);
  check.near("residual", got.residual, std::sqrt(squares / std::max(count, 1.)), 0.005, "m");
}

// The reference, over 1500 pairs: 1.6 cm and 0.008 rad on average, with deviations of 1.2 cm and 0.007 rad;
// 10.4 cm and 0.044 rad at most, and an overlap of 0.82 at least.
void alignsPairs(Check& check, Student& student, int pairs) {
  double way = 0, turn = 0, worst = -1;
  ScanPair pair, worstPair;
  Aligned got, worstGot;
  const auto shown = check.show([&] {
    return scansSeen("The worst pair of scans so far", worstPair, worstGot.motion, worstPair.motion);
  });
  for (int k = 0; k < pairs; ++k) {
    pair = pairOfScans(check.rng());
    got = student.aligned(pair.reference, pair.moving, pair.guess);
    check.shape("motion", got.motion, 3, 1);
    const auto [metres, radians] = missOf(got.motion, pair.motion);
    if (metres > worst) {
      worst = metres;
      worstPair = pair;
      worstGot = got;
    }
    check.atMost("position error of a motion", metres, 0.2, "m");
    check.atMost("its heading error", radians, 0.1, "rad");
    way += metres / pairs;
    turn += radians / pairs;
    fitsAsItSays(check, pair, got);
  }
  check.atMost("average position error", way, 0.04, "m");
  check.atMost("average heading error", turn, 0.02, "rad");
}

void alignsScans(Check& check, Student& student) {
  check.input("20 pairs of scans of random rooms, guesses up to 0.28 m and 0.2 rad off");
  alignsPairs(check, student, 20);
}

// <hidden>
void alignsMoreScans(Check& check, Student& student) { alignsPairs(check, student, 30); }
// </hidden>

// Part 5.

// The reference finds all of 700 pairs of one place, and takes one pair of 700 strangers for the same.
void tellsPlacesApart(Check& check, Student& student, int pairs) {
  int right = 0, wrong = 0;
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
      check.shape("motion", *motion, 3, 1);
      const auto [metres, radians] = missOf(*motion, pair.motion);
      isRight = metres < 0.2 && radians < 0.1;
    }
    right += isRight ? 1 : 0;
    if (!isRight && !lost) {
      lost = pair;
      gotOfLost = motion;
    }
  }
  check.atLeast("pairs of one place that are found with the right motion", right, 0.9 * pairs);
  check.atMost("pairs of different rooms taken for one place", wrong, 0.1 * pairs);
}

void tellsRoomsApart(Check& check, Student& student) {
  check.input("40 pairs of scans of one room, and 40 of two different ones");
  tellsPlacesApart(check, student, 40);
}

// <hidden>
void tellsMoreRoomsApart(Check& check, Student& student) { tellsPlacesApart(check, student, 50); }
// </hidden>

// Part 6.

// Wrong loops join poses that are metres apart, as if they were one place. Neither measurements nor indices
// of poses give them away: they have the same rotations and noise as right ones, and span the same numbers
// of steps, because a walk comes by again after 20, 30, 40, ... of them.
void addWrongLoops(Rng& rng, StreetWalk& walk, double share) {
  std::vector<MeasuredEdge> right;
  for (const MeasuredEdge& edge : walk.map.edges)
    if (edge.isLoop) right.push_back(edge);
  const auto loops = static_cast<int>(right.size()), poses = static_cast<int>(walk.truth.size());
  const auto truth = [&](int k) { return walk.truth[static_cast<std::size_t>(k)]; };
  const int count = std::max(1, static_cast<int>(share / (1 - share) * loops));
  for (int k = 0; k < count;) {
    const int i = rng.index(poses), j = rng.index(poses);
    if (std::abs(i - j) < 20 || (i - j) % 10 != 0 || missOf(truth(i), truth(j)).first < 3) continue;
    const MeasuredEdge& like = right[static_cast<std::size_t>(rng.index(loops))];
    const Eigen::Vector3d turn(0, 0, truth(like.to)[2] - truth(like.from)[2]),
        deviations = like.information.diagonal().cwiseInverse().cwiseSqrt();
    walk.map.edges.push_back(
        {i, j, onward(turn, deviations.cwiseProduct(rng.normalVector(3))), like.information, true});
    ++k;
  }
  // The position of an edge in the list does not show whether it is right.
  std::vector<MeasuredEdge> edges, mixed;
  for (const MeasuredEdge& edge : walk.map.edges) (edge.isLoop ? mixed : edges).push_back(edge);
  for (std::size_t k = mixed.size(); k > 1; --k)
    std::swap(mixed[k - 1], mixed[static_cast<std::size_t>(rng.index(static_cast<int>(k)))]);
  edges.insert(edges.end(), mixed.begin(), mixed.end());
  walk.map.edges = std::move(edges);
}

// Whether odometry drifts so far that no bound on the distance between the ends of a loop keeps the right
// loops and drops the wrong ones.
bool isBeyondOdometry(const StreetWalk& walk, const Poses& best) {
  return std::ranges::none_of(std::array{2., 3., 4.5}, [&](double bound) {
    PoseMap near = walk.map;
    std::erase_if(near.edges, [&](const MeasuredEdge& edge) {
      const auto pose = [&](int k) { return walk.map.poses[static_cast<std::size_t>(k)]; };
      return edge.isLoop && missOf(pose(edge.from), pose(edge.to)).first > bound;
    });
    return apart(bestPoses(near), best) < 0.1;
  });
}

/// A walk with wrong loops, and its poses without them.
struct Misled {
  StreetWalk walk;
  Poses best;
};

Misled misledWalk(Rng& rng, double noise, double share) {
  for (;;) {
    StreetWalk walk = streetWalk(rng, 120, noise);
    const Poses best = bestPoses(walk.map);
    addWrongLoops(rng, walk, share);
    if (isBeyondOdometry(walk, best)) return {walk, best};
  }
}

// Some wrong loops cannot be distinguished from right ones: of 200 maps each, the reference repairs 90 % of
// those with a few wrong loops and 86 % of those with many; bounds of 1.5 to 6 m on the distance by
// odometry repair at most 15 %.
void standsOnManyMaps(Check& check, Student& student, double noise, double share) {
  int right = 0;
  JudgedWalk wrong;
  for (int k = 0; k < 12; ++k) {
    const Misled misled = misledWalk(check.rng(), noise, share);
    const Poses got = student.robustlyAdjusted(misled.walk.map);
    checkPoses(check, got, misled.walk.map.poses);
    if (apart(got, misled.best) < 0.1)
      ++right;
    else
      wrong = {misled.walk, got, misled.best};
  }
  const auto shown = check.show([&] { return robustSeen(wrong); });
  check.atLeast("number of twelve maps that are as without the wrong loops, within 10 cm", right, 5);
}

void standsAFew(Check& check, Student& student) {
  check.input("twelve walks of 120 poses along streets; one of ten loops is wrong");
  standsOnManyMaps(check, student, 0.1, 0.1);
}

// <hidden>
void standsMany(Check& check, Student& student) { standsOnManyMaps(check, student, 0.08, 0.28); }
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"error-frames", "error", "Angles and frames", 1, Group::kVisible, seesPoses},
      {"error-edges", "error", "The error of an edge", 1, Group::kVisible, errsByWhatIsMeasured},
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
      {"adjust-mean", "adjust", "Measured twice", 1, Group::kVisible, meetsInTheMiddle},
      {"adjust-streets", "adjust", "A walk along streets", 1, Group::kVisible, adjustsStreets},
      // <hidden>
      {"adjust-turns", "adjust", "Headings beyond half a turn", 1, Group::kHidden, adjustsThroughTurns},
      {"adjust-far", "adjust", "Starts far away", 1, Group::kHidden, adjustsFromFarAway},
      // </hidden>
      {"scan-partners", "scan", "The nearest points", 1, Group::kVisible, findsPartners},
      {"scan-motion", "scan", "The best motion for given partners", 1, Group::kVisible, findsBestMotions},
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
  };
}
