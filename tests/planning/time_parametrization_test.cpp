#include "planning/time_parametrization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/inverse_dynamics.h"
#include "formats/ors_reader.h"
#include "formats/scene_file.h"
#include "planning/path_spline.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::time_parametrization_test {

using std::numbers::pi;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kInf = std::numeric_limits<double>::infinity();

PathProblem freeSpace(int size) {
  return {.space = Space::box(Eigen::VectorXd::Constant(size, -100), Eigen::VectorXd::Constant(size, 100)),
          .allValid = eachColumn([](const VectorArg&) { return true; }),
          .resolution = 1};
}

PathCurve straight(const Eigen::VectorXd& to) {
  Eigen::MatrixXd path = Eigen::MatrixXd::Zero(to.size(), 2);
  path.col(1) = to;
  return straightCurve(freeSpace(static_cast<int>(to.size())).space, path);
}

PathCurve randomSpline(int size, int corners, Rng& rng) {
  Eigen::MatrixXd path(size, corners);
  for (double& number : path.reshaped()) number = rng.uniform(-2, 2);
  return splineAlong(freeSpace(size), path).spline.curve();
}

MotionLimits randomLimits(int size, Rng& rng) {
  return {.velocity = rng.uniformVector(size, .5, 2), .acceleration = rng.uniformVector(size, .5, 5)};
}

// Coordinate k is radius * cos(s + phase k): accelerations in all directions of the plane of a circle.
PathCurve circle(int directions, double radius, double length) {
  const auto at = [=](double s, CurvePoint& point) {
    const Eigen::ArrayXd angles =
        s + Eigen::ArrayXd::LinSpaced(directions, 0, directions - 1) * pi / directions;
    point.q = radius * angles.cos();
    point.dq = -radius * angles.sin();
    point.ddq = -point.q;
  };
  CurvePoint first;
  at(0, first);
  return {.start = first.q, .pieces = {{.length = length, .at = at}}};
}

double durationOf(const PathCurve& curve, const MotionLimits& limits, const TimingOptions& options = {}) {
  const TimingResult result = parametrizeTime(curve, limits, options);
  EXPECT_EQ(result.status, TimingStatus::kFound) << result.message;
  EXPECT_LE(result.lowerBound, result.motion.duration() * (1 + options.excess));
  return result.motion.duration();
}

// The largest share of a limit that is used.
double share(const MotionPoint& point, const MotionLimits& limits) {
  double most = (point.v.array().abs() / limits.velocity.array()).maxCoeff();
  if (limits.acceleration.size() > 0)
    most = std::max(most, (point.a.array().abs() / limits.acceleration.array()).maxCoeff());
  if (limits.effort.size() > 0) {
    Eigen::VectorXd u(point.v.size());
    limits.forces(point.q, point.v, point.a, u);
    most = std::max(most, (u.array().abs() / limits.effort.array()).maxCoeff());
  }
  return most;
}

// From either side of each point of the grid, and between them. Gives back at how many points no limit is
// used by 95 %.
int expectWithinLimits(const TimedPath& motion, const MotionLimits& limits, double excess) {
  const std::vector<double>& times = motion.times();
  int slack = 0;
  double before = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double step = times[i + 1] - times[i];
    const double begin = share(motion.at(times[i]), limits);
    const double end = share(motion.at(times[i + 1] - 1e-9 * step), limits);
    EXPECT_LE(begin, 1 + 1e-6) << i;
    EXPECT_LE(end, 1 + 1e-6) << i;
    for (double part = .1; part < .95; part += .1)
      EXPECT_LE(share(motion.at(times[i] + part * step), limits), 1 + excess) << i;
    slack += std::max(begin, before) < .95 ? 1 : 0;
    before = end;
  }
  return slack;
}

TEST(TimeParametrization, IsATrapezoidOnAStraightWay) {
  const auto limits = [](double v, double a) {
    return MotionLimits{.velocity = Eigen::VectorXd::Constant(1, v),
                        .acceleration = Eigen::VectorXd::Constant(1, a)};
  };
  const Eigen::VectorXd way = Eigen::VectorXd::Constant(1, -2);
  EXPECT_NEAR(durationOf(straight(way), limits(1, 2)), 2 / 1. + 1 / 2., 1e-3);
  EXPECT_NEAR(durationOf(straight(way), limits(100, 2)), 2 * std::sqrt(2 / 2.), 1e-3) << "a triangle";
  const TimingResult result = parametrizeTime(straight(way), limits(1, 2));
  EXPECT_NEAR(result.lowerBound, 2, 1e-12);
  EXPECT_THAT(result.message,
              HasSubstr("s, at least 2 s at the velocity limits, on a grid of 1000 intervals"));
  for (const auto& [t, x] : {std::pair(.25, -.0625), {.5, -.25}, {1.25, -1.}, {2.25, -1.9375}, {9., -2.}})
    EXPECT_NEAR(result.motion.at(t).q[0], x, 1e-3) << t;
  EXPECT_NEAR(result.motion.at(.3).a[0], -2, 1e-9);
  EXPECT_NEAR(result.motion.at(1.2).v[0], -1, 1e-9);
  EXPECT_NEAR(result.motion.at(2.3).a[0], 2, 1e-9);
}

TEST(TimeParametrization, WaitsForTheSlowestOfSeveralJoints) {
  Rng rng(5);
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd way = rng.normalVector(4);
    const MotionLimits limits = randomLimits(4, rng);
    const double v = (limits.velocity.array() / way.array().abs()).minCoeff();
    const double a = (limits.acceleration.array() / way.array().abs()).minCoeff();
    const double expected = v * v >= a ? 2 / std::sqrt(a) : 1 / v + v / a;
    EXPECT_NEAR(durationOf(straight(way), limits), expected, .002 * expected) << i;
  }
}

TEST(TimeParametrization, TakesTheSpeedsAtTheEnds) {
  const MotionLimits limits{.velocity = Eigen::VectorXd::Constant(1, 2),
                            .acceleration = Eigen::VectorXd::Constant(1, 1)};
  // From 1 to 2 in a second and 3/2 metres, on with 2, from 2 to 0 in two seconds and 2 metres.
  const double expected = 1 + (9 - 1.5 - 2) / 2 + 2;
  const PathCurve curve = straight(Eigen::VectorXd::Constant(1, 9));
  EXPECT_NEAR(durationOf(curve, limits, {.startSpeed = 1}), expected, 1e-3);
  EXPECT_NEAR(durationOf(curve, limits, {.endSpeed = 1}), expected, 1e-3);
  const TimingResult result = parametrizeTime(curve, limits, {.startSpeed = 1, .endSpeed = 2});
  EXPECT_NEAR(result.motion.at(0).v[0], 1, 1e-12);
  EXPECT_NEAR(result.motion.at(100).v[0], 2, 1e-12);
}

// In all directions accelerations are at most a: a circle of radius r is followed with a^(1/2) r^(-1/2)
// rad/s.
TEST(TimeParametrization, IsBoundByTheCentripetalAccelerationOnACircle) {
  constexpr double kRadius = .7, kLimit = 3;
  const MotionLimits limits{.velocity = Eigen::VectorXd::Constant(64, 100),
                            .acceleration = Eigen::VectorXd::Constant(64, kLimit)};
  const double speed = std::sqrt(kLimit / kRadius);
  const PathCurve curve = circle(64, kRadius, 2 * pi);
  EXPECT_NEAR(durationOf(curve, limits, {.startSpeed = speed, .endSpeed = speed}), 2 * pi / speed,
              .01 * 2 * pi / speed);
  // From rest the square of the speed is speed^2 sin(2 s) until s = pi/4, the integral that of a lemniscate.
  constexpr double kLemniscate = 2.622057554292119;
  const double expected = (kLemniscate + 2 * pi - pi / 2) / speed;
  EXPECT_NEAR(durationOf(curve, limits), expected, .01 * expected);
}

TEST(TimeParametrization, FollowsVelocitiesAloneAsFastAsTheyAllow) {
  const auto at = [](double s, CurvePoint& point) {
    point.q = Eigen::Vector2d(s, s * s / 2);
    point.dq = Eigen::Vector2d(1, s);
    point.ddq = Eigen::Vector2d(0, 1);
  };
  const PathCurve parabola{.start = Eigen::Vector2d(0, 0), .pieces = {{.length = 4, .at = at}}};
  const MotionLimits limits{.velocity = Eigen::Vector2d(1, 2)};
  const double expected = 2 + (16 - 4) / 4.;  // the first number is the slower one until s = 2
  EXPECT_NEAR(durationOf(parabola, limits, {.startSpeed = 1, .endSpeed = .5}), expected, 1e-3 * expected);
  EXPECT_NEAR(durationOf(parabola, limits), expected, 1e-2 * expected) << "ends at rest take two intervals";
  const TimingResult result = parametrizeTime(parabola, limits, {.startSpeed = 1, .endSpeed = .5});
  EXPECT_NEAR(result.lowerBound, expected, 1e-3 * expected);
}

// A load on a vertical rail goes up with F/m - g and is slowed by F/m + g.
TEST(TimeParametrization, KeepsToEfforts) {
  SceneSpec spec = parseOrs(
                       "body post {} body load { type=0 size=[.1 .1 .1 0] mass=2 }\n"
                       "joint lift (post load) { type=transZ limits=[-5 5] }\n",
                       "lift.ors")
                       .spec;
  spec.joints[0].maxVelocity = 100, spec.joints[0].maxEffort = 30;
  const Model model = compile(spec);
  MotionLimits limits = jointLimits(model, {.effort = true}).limits;
  limits.acceleration.resize(0);
  const double up = 30 / 2. - 9.81, down = 30 / 2. + 9.81;
  const double expected = std::sqrt(2 * 3 * (up + down) / (up * down));
  EXPECT_NEAR(durationOf(straight(Eigen::VectorXd::Constant(1, 3)), limits), expected, .01 * expected);
  EXPECT_NEAR(durationOf(straight(Eigen::VectorXd::Constant(1, -3)), limits), expected, .01 * expected);
  limits.effort.setConstant(19);
  const TimingResult result = parametrizeTime(straight(Eigen::VectorXd::Constant(1, -3)), limits);
  EXPECT_EQ(result.status, TimingStatus::kInfeasible);
  EXPECT_EQ(
      result.message,
      "no motion along the path: at s = 2.997 of 3: the effort of 'lift' is 19.62 even at rest, limit 19");
  EXPECT_THAT(
      parametrizeTime(straight(Eigen::VectorXd::Constant(1, 3)), limits).message,
      ::testing::MatchesRegex("no motion along the path: at s = 0 of 3: the path cannot be followed from "
                              "the speed 0, only from 1.36[0-9]* to [0-9.]*; the effort of 'lift' is 19.62 "
                              "even at rest, limit 19"));
  EXPECT_EQ(result.motion.duration(), 0);
  EXPECT_EQ(result.motion.at(1).q[0], 0);
}

TEST(TimeParametrization, UsesALimitAlmostEverywhereOnRandomSplines) {
  Rng rng(11);
  int points = 0, slack = 0;
  for (int i = 0; i < 30; ++i) {
    const int size = 1 + rng.index(7);
    const PathCurve curve = randomSpline(size, 2 + rng.index(8), rng);
    const MotionLimits limits = randomLimits(size, rng);
    const TimingResult result = parametrizeTime(curve, limits);
    ASSERT_EQ(result.status, TimingStatus::kFound) << result.message;
    EXPECT_LE(result.excess, .01) << i;
    const int here = expectWithinLimits(result.motion, limits, .02);
    EXPECT_LE(here, 2 * static_cast<int>(curve.pieces.size())) << "switches of spline " << i;
    slack += here;
    points += static_cast<int>(result.motion.times().size());
    const MotionPoint end = result.motion.at(result.motion.duration());
    EXPECT_TRUE(end.v.isZero(1e-12));
  }
  EXPECT_LT(slack, .02 * points) << "of " << points;
}

// Joints may use what holds them, and half of what they would need beyond that to be as fast as without
// limits.
TEST(TimeParametrization, UsesEffortsOfAnArm) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  MotionLimits limits = jointLimits(model, {.ramp = .1, .effort = true}).limits;
  Rng rng(2);
  for (int i = 0; i < 3; ++i) {
    const PathCurve curve = randomSpline(7, 4, rng);
    const MotionLimits anyEffort{.velocity = limits.velocity, .acceleration = limits.acceleration};
    const TimedPath free = parametrizeTime(curve, anyEffort).motion;
    Eigen::ArrayXd held = Eigen::ArrayXd::Zero(7), moved = held;
    for (const double t : free.times()) {
      const MotionPoint point = free.at(t);
      held = held.max(gravityForces(model, point.q).array().abs());
      moved = moved.max(inverseDynamics(model, point.q, point.v, point.a).array().abs());
    }
    limits.effort = 1.05 * held + .5 * (moved - held).max(0) + .1;
    const TimingResult result = parametrizeTime(curve, limits);
    ASSERT_EQ(result.status, TimingStatus::kFound) << result.message;
    EXPECT_GT(result.motion.duration(), 1.02 * free.duration()) << "efforts are felt";
    EXPECT_LT(expectWithinLimits(result.motion, limits, .03),
              .05 * static_cast<double>(result.motion.times().size()));
  }
}

// Moments and derivatives of a motion fit together.
TEST(TimeParametrization, GivesVelocitiesAndAccelerationsOfItsPostures) {
  Rng rng(8);
  const TimedPath motion = parametrizeTime(randomSpline(3, 5, rng), randomLimits(3, rng)).motion;
  constexpr double kStep = 1e-6;
  for (std::size_t i = 0; i + 1 < motion.times().size(); i += 7) {
    const double t = (motion.times()[i] + motion.times()[i + 1]) / 2;
    const MotionPoint before = motion.at(t - kStep), here = motion.at(t), after = motion.at(t + kStep);
    EXPECT_LT(((after.q - before.q) / (2 * kStep) - here.v).norm(), 1e-6);
    EXPECT_LT(((after.v - before.v) / (2 * kStep) - here.a).norm(), 1e-4);
  }
}

PathCurve reversed(const PathCurve& curve) {
  PathCurve back;
  for (std::size_t i = curve.pieces.size(); i-- > 0;) {
    const CurvePiece piece = curve.pieces[i];
    back.pieces.push_back({.length = piece.length,
                           .at =
                               [piece](double s, CurvePoint& point) {
                                 piece.at(piece.length - s, point);
                                 point.dq *= -1;
                               },
                           .stopsAtEnd = i > 0 && curve.pieces[i - 1].stopsAtEnd});
  }
  CurvePoint first;
  back.pieces.front().at(0, first);
  back.start = first.q;
  return back;
}

TEST(TimeParametrization, ObeysTheLawsOfTime) {
  Rng rng(21);
  for (int i = 0; i < 10; ++i) {
    const PathCurve curve = randomSpline(3, 3 + rng.index(5), rng);
    const MotionLimits limits = randomLimits(3, rng);
    const double duration = durationOf(curve, limits);
    EXPECT_NEAR(durationOf(reversed(curve), limits), duration, 2e-3 * duration) << "backwards " << i;
    const MotionLimits faster{.velocity = 3 * limits.velocity, .acceleration = 9 * limits.acceleration};
    EXPECT_NEAR(3 * durationOf(curve, faster), duration, 1e-6 * duration) << "another unit of time " << i;
    MotionLimits wider = limits;
    wider.acceleration[i % 3] *= 1.5;
    EXPECT_LE(durationOf(curve, wider), duration * (1 + 2e-3)) << i;
    EXPECT_NEAR(durationOf(curve, limits, {.intervals = 4000}), duration, 5e-3 * duration)
        << "the grid " << i;
  }
}

// A second opinion: the shortest time over all profiles of a table of speeds, by dynamic programming. Limits
// are asked for in the middle of intervals only; no linear programs, and no passes of extremes.
double durationByTables(const PathCurve& curve, const MotionLimits& limits, double fastest) {
  constexpr int kIntervals = 120;
  constexpr std::size_t kSpeeds = 1000;
  const double way = curve.length() / kIntervals;
  std::vector<double> least(kSpeeds, kInf);
  least[0] = 0;
  const auto squared = [&](std::size_t k) {
    const double speed = fastest * static_cast<double>(k) / (kSpeeds - 1);
    return speed * speed;
  };
  for (int i = kIntervals; i-- > 0;) {
    double s = (i + .5) * way;
    std::size_t p = 0;
    while (p + 1 < curve.pieces.size() && s > curve.pieces[p].length) s -= curve.pieces[p++].length;
    CurvePoint point;
    curve.pieces[p].at(s, point);
    const Eigen::Array2d dq = point.dq, ddq = point.ddq, most = limits.acceleration, v = limits.velocity;
    std::vector<double> next(kSpeeds, kInf);
    for (std::size_t k = 0; k < kSpeeds; ++k) {
      for (std::size_t m = 0; m < kSpeeds; ++m) {
        const double x = squared(k), y = squared(m), u = (y - x) / (2 * way), mean = (x + y) / 2;
        const bool isAllowed = std::isfinite(least[m]) && ((dq * u + ddq * mean).abs() <= most).all() &&
                               (dq.square() * mean <= v.square()).all();
        if (isAllowed) next[k] = std::min(next[k], 2 * way / (std::sqrt(x) + std::sqrt(y)) + least[m]);
      }
    }
    least = std::move(next);
  }
  return least[0];
}

TEST(TimeParametrization, AgreesWithTablesOfSpeeds) {
  Rng rng(17);
  for (int i = 0; i < 4; ++i) {
    const PathCurve curve = randomSpline(2, 4, rng);
    const MotionLimits limits = randomLimits(2, rng);
    const TimedPath motion = parametrizeTime(curve, limits).motion;
    const double fastest = std::sqrt(*std::max_element(motion.squares().begin(), motion.squares().end()));
    const double byTables = durationByTables(curve, limits, 1.2 * fastest);
    EXPECT_NEAR(motion.duration(), byTables, .03 * byTables) << i;
  }
}

TEST(TimeParametrization, StopsAtCorners) {
  Eigen::MatrixXd path(2, 3);
  path << 0, 1, 1, 0, 0, 2;
  const MotionLimits limits{.velocity = Eigen::Vector2d(10, 10), .acceleration = Eigen::Vector2d(1, 1)};
  const TimedPath motion = parametrizeTime(straightCurve(freeSpace(2).space, path), limits).motion;
  EXPECT_NEAR(motion.duration(), 2 + 2 * std::sqrt(2), 1e-2);
  EXPECT_NEAR(motion.at(2).v.norm(), 0, 1e-2);
  EXPECT_LT((motion.at(2).q - path.col(1)).norm(), 1e-2);
}

// There and back on one line: at the turn the derivative is zero, and the acceleration is not.
TEST(TimeParametrization, TurnsBackOnALine) {
  Eigen::MatrixXd path(1, 3);
  path << 0, 3, 0;
  const PathCurve curve = splineAlong(freeSpace(1), path).spline.curve();
  const MotionLimits limits{.velocity = Eigen::VectorXd::Constant(1, 10),
                            .acceleration = Eigen::VectorXd::Constant(1, 1)};
  const double farthest = 2;  // of the spline: two thirds of the corner
  EXPECT_NEAR(durationOf(curve, limits), 2 * 2 * std::sqrt(farthest), .05);
}

TEST(TimeParametrization, RestsAtASinglePosture) {
  const TimingResult result =
      parametrizeTime({.start = Eigen::Vector2d(1, 2)}, {.velocity = Eigen::Vector2d(1, 1)});
  EXPECT_EQ(result.status, TimingStatus::kFound);
  EXPECT_EQ(result.message, "0 s: the path is a single point");
  EXPECT_EQ(result.motion.duration(), 0);
  EXPECT_EQ(result.motion.at(3).q, Eigen::Vector2d(1, 2));
  EXPECT_TRUE(result.motion.at(3).v.isZero(0));
}

TEST(TimeParametrization, SaysWhichSpeedsAtTheEndsCannotBe) {
  MotionLimits limits{
      .velocity = Eigen::Vector2d(1, 1), .acceleration = Eigen::Vector2d(1, 1), .names = {"a", "b"}};
  const PathCurve curve = straight(Eigen::Vector2d(0, 2));
  const auto message = [&](const TimingOptions& options) {
    const TimingResult result = parametrizeTime(curve, limits, options);
    EXPECT_EQ(result.status, TimingStatus::kInfeasible);
    return result.message;
  };
  EXPECT_EQ(
      message({.startSpeed = 3}),
      "no motion along the path: at s = 0 of 2: the speed at the start, 3, exceeds the velocity of 'b', "
      "which allows 1");
  EXPECT_EQ(message({.endSpeed = 3}),
            "no motion along the path: at s = 2 of 2: the speed at the end, 3, exceeds the velocity of 'b', "
            "which allows 1");
  limits.velocity.setConstant(10);
  EXPECT_EQ(
      message({.startSpeed = 9}),
      "no motion along the path: at s = 0 of 2: the path cannot be followed from the speed 9, only from 0 "
      "to 2");
}

// The second number holds the path back until shortly before the end; the first cannot speed up so soon.
TEST(TimeParametrization, SaysWhichLimitsLeaveNoSpeed) {
  const auto at = [](double s, CurvePoint& point) {
    point = {Eigen::Vector2d(s, 10 * s - 5 * s * s), Eigen::Vector2d(1, 10 - 10 * s),
             Eigen::Vector2d(0, -10)};
  };
  const PathCurve curve{.start = Eigen::Vector2d(0, 0), .pieces = {{.length = 1, .at = at}}};
  const MotionLimits limits{.velocity = Eigen::Vector2d(1, 1),
                            .acceleration = Eigen::Vector2d(.1, kInf),
                            .names = {"slow", "held back"}};
  const TimingResult result = parametrizeTime(curve, limits, {.endSpeed = 1});
  EXPECT_EQ(result.status, TimingStatus::kInfeasible) << result.message;
  EXPECT_THAT(result.message, StartsWith("no motion along the path: at s = 0.89"));
  EXPECT_THAT(result.message,
              HasSubstr(" of 1: the speeds needed later and the acceleration of 'slow' allow no speed"));
}

TEST(TimeParametrization, RefusesWhatMakesNoSense) {
  const PathCurve curve = straight(Eigen::Vector2d(1, 2));
  const MotionLimits good{.velocity = Eigen::Vector2d(1, 1)};
  const auto run = [&](const MotionLimits& limits, const TimingOptions& options = {}) {
    static_cast<void>(parametrizeTime(curve, limits, options));
  };
  EXPECT_REX_ERROR(run({.velocity = Eigen::Vector3d(1, 1, 1)}),
                   "velocity limits: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(run({.velocity = Eigen::Vector2d(1, 0)}),
                   "velocity limits: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(run({.velocity = Eigen::Vector2d(kInf, 1)}),
                   "velocity limits: found inf, wanted a positive, finite number");
  EXPECT_REX_ERROR(run({.velocity = good.velocity, .acceleration = Eigen::Vector2d(1, -1)}),
                   "acceleration limits: found -1, wanted a positive number, or infinity");
  EXPECT_REX_ERROR(run({.velocity = good.velocity, .effort = Eigen::Vector2d(1, NAN)}),
                   "effort limits: found nan, wanted a positive number, or infinity");
  EXPECT_REX_ERROR(run({.velocity = good.velocity, .effort = Eigen::Vector2d(1, 1)}),
                   "effort limits: found no forces, wanted a function for inverse dynamics");
  EXPECT_REX_ERROR(run({.velocity = good.velocity, .names = {"a"}}),
                   "names of coordinates: found a vector of size 1, wanted size 2");
  EXPECT_REX_ERROR(run(good, {.startSpeed = -1}),
                   "speed at the start of a path: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(run(good, {.endSpeed = NAN}), "speed at the end of a path: found nan");
  EXPECT_REX_ERROR(run(good, {.intervals = 0}), "intervals of a path: found 0, wanted 1 to 1e+06");
  EXPECT_REX_ERROR(
      run(good, {.excess = 0}),
      "excess over limits between points of the grid: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(static_cast<void>(parametrizeTime(curve, good).motion.at(NAN)),
                   "time on a path: found nan");
}

TEST(TimeParametrization, RefusesPathsThatDoNotJoin) {
  const auto run = [&](const PathCurve& curve) {
    static_cast<void>(parametrizeTime(curve, {.velocity = Eigen::Vector2d(1, 1)}));
  };
  PathCurve curve = straight(Eigen::Vector2d(3, 0));
  const CurvePiece onward = curve.pieces[0];
  curve.start[0] = 1;
  EXPECT_REX_ERROR(run(curve),
                   "path at s = 0, piece 0: found a jump of 1, wanted the end of the piece before");
  curve.start[0] = 0;
  const auto upward = [](double s, CurvePoint& point) {
    point = {Eigen::Vector2d(3, s), Eigen::Vector2d(0, 1), Eigen::Vector2d(0, 0)};
  };
  curve.pieces.push_back({.length = 1, .at = upward});
  EXPECT_REX_ERROR(
      run(curve),
      "path at s = 3, piece 1: found a corner: the derivative changes by 1, wanted the derivative "
      "of the piece before, or a stop there");
  curve.pieces[0].stopsAtEnd = true;
  run(curve);
  curve.pieces[1].length = 0;
  EXPECT_REX_ERROR(run(curve), "length of piece 1 of a path: found 0, wanted a positive, finite number");
  curve.pieces[1] = {
      .length = 1, .at = [](double s, CurvePoint& point) {
        point = {Eigen::Vector2d(3, s), Eigen::Vector2d(0, s > .3 ? NAN : 1), Eigen::Vector2d(0, 0)};
      }};
  EXPECT_REX_ERROR(run(curve), "piece 1 of a path, at ");
  curve.pieces[1].at = [](double, CurvePoint& point) { point = {Eigen::Vector3d(3, 0, 0), {}, {}}; };
  EXPECT_REX_ERROR(run(curve), "numbers of a path: found a vector of size 3, wanted size 2");
}

}  // namespace rex::time_parametrization_test
