#include "planning/path_spline.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "planning/wall.h"
#include "support/expect_error.h"

namespace rex::path_spline_test {

MotionLimits limitsOf(int size) {
  return {.velocity = Eigen::VectorXd::Constant(size, .5),
          .acceleration = Eigen::VectorXd::Constant(size, 2)};
}

Eigen::MatrixXd shortPath(const PathProblem& problem, std::uint64_t seed) {
  Rng rng(seed);
  return shortcut(problem, connectRrts(problem, {.stepSize = .1}, rng).path, 100, rng);
}

// Values against differences of those they derive from, also across the joints of the pieces, where each has
// a value from either side.
void expectTwiceDifferentiable(const PathSpline& spline) {
  constexpr double kStep = 1e-6;
  const double pieces = static_cast<double>(spline.control().cols() - 3);
  const double scale = spline.control().cwiseAbs().maxCoeff() + 1;
  for (double piece = 0; piece < pieces; piece += .25) {
    const double t = spline.duration() * (piece + .25) / pieces;
    const Eigen::VectorXd before = spline.position(t - kStep), after = spline.position(t + kStep);
    EXPECT_LT((spline.velocity(t) - (after - before) / (2 * kStep)).norm(), 1e-7 * scale);
    const Eigen::VectorXd slower = spline.velocity(t - kStep), faster = spline.velocity(t + kStep);
    if (piece + .25 < pieces) {
      EXPECT_LT((spline.acceleration(t) - (faster - slower) / (2 * kStep)).norm(), 1e-3);
    }
    EXPECT_LT((spline.acceleration(t - 1e-9) - spline.acceleration(t + 1e-9)).norm(), 1e-5) << "a jump";
  }
}

// Walls that are half the resolution thicker for the planner, so that what it checks in points is clear of
// the true ones in between.
PathProblem thickened(const PathProblem& problem) {
  PathProblem thick = problem;
  thick.allValid = eachColumn([problem](const VectorArg& q) {
    bool isValid = problem.allValid(q);
    for (int corner = 0; corner < 1 << q.size() && isValid; ++corner) {
      Eigen::VectorXd beside = q;
      for (Eigen::Index i = 0; i < q.size(); ++i)
        beside[i] += (corner >> i & 1 ? .5 : -.5) * problem.resolution;
      isValid = problem.allValid(beside);
    }
    return isValid;
  });
  return thick;
}

// The length, by far more points than any check looks at.
double expectValid(const PathProblem& problem, const PathSpline& spline) {
  double length = 0;
  Eigen::VectorXd last = spline.position(0);
  constexpr int kPoints = 20000;
  for (int i = 1; i <= kPoints; ++i) {
    const Eigen::VectorXd q = spline.position(spline.duration() * i / kPoints);
    length += problem.space.distance(last, q);
    EXPECT_TRUE(problem.allValid(q)) << i;
    last = q;
  }
  return length;
}

TEST(PathSpline, GoesThroughTheHoleInTheWall) {
  int smooth = 0;
  for (const int dimension : {2, 3}) {
    const PathProblem problem = wallWithHole(dimension, .2), thick = thickened(problem);
    const MotionLimits limits = limitsOf(dimension);
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
      const Eigen::MatrixXd path = shortPath(thick, seed);
      const SplineResult result = splineAlong(thick, path, limits);
      ASSERT_NE(result.status, SplineStatus::kInvalid) << result.message;
      EXPECT_EQ(result.status == SplineStatus::kSmooth, result.stops == 0);
      smooth += result.stops == 0 ? 1 : 0;
      const PathSpline& spline = result.spline;
      EXPECT_LT((spline.position(0) - problem.start).norm(), 1e-15);
      EXPECT_LT((spline.position(spline.duration()) - problem.goal).norm(), 1e-15);
      EXPECT_LE(expectValid(problem, spline), pathLength(problem.space, path) + 1e-9);
      expectTwiceDifferentiable(spline);
      for (const double end : {0., spline.duration()}) {
        EXPECT_LT(spline.velocity(end).norm(), 1e-12);
        EXPECT_LT(spline.acceleration(end).norm(), 1e-9);
      }
      double fastest = 0, hardest = 0;
      for (int i = 0; i <= 1000; ++i) {
        const double t = spline.duration() * i / 1000;
        fastest = std::max(fastest, spline.velocity(t).cwiseAbs().maxCoeff());
        hardest = std::max(hardest, spline.acceleration(t).cwiseAbs().maxCoeff());
      }
      EXPECT_LE(fastest, .5 + 1e-12);
      EXPECT_LE(hardest, 2 + 1e-12);
      EXPECT_GT(std::max(fastest / .5, hardest / 2), .99) << "it does not dawdle";
    }
  }
  EXPECT_GT(smooth, 20) << "of 30";
}

TEST(PathSpline, IsSmoothWhereThereIsRoom) {
  PathProblem problem = wallWithHole(2, .2);
  Eigen::MatrixXd corner(2, 3);
  corner << .1, .3, .3, .1, .1, .4;
  problem.start = corner.col(0);
  problem.goal = corner.col(2);
  const SplineResult result = splineAlong(problem, corner, limitsOf(2));
  EXPECT_EQ(result.status, SplineStatus::kSmooth);
  EXPECT_EQ(result.spline.control().cols(), 7);
  EXPECT_NE(result.message.find("7 control points and 0 stops"), std::string::npos) << result.message;
  // A third of the corner, a sixth of each neighbour: the middle of a uniform cubic B-spline.
  const Eigen::Vector2d middle = (corner.col(0) + 4 * corner.col(1) + corner.col(2)) / 6;
  EXPECT_LT((result.spline.position(result.spline.duration() / 2) - middle).norm(), 1e-12);
}

// Free is only what is on the path itself.
TEST(PathSpline, StopsAtCornersWithoutRoom) {
  Eigen::MatrixXd path(2, 4);
  path << .1, .5, .5, .9, .2, .2, .7, .7;
  const auto onPath = [](const VectorArg& q) {
    const bool isLow = std::abs(q[1] - .2) < 1e-9 && q[0] < .5 + 1e-9;
    const bool isUp = std::abs(q[0] - .5) < 1e-9, isHigh = std::abs(q[1] - .7) < 1e-9 && q[0] > .5 - 1e-9;
    return isLow || isUp || isHigh;
  };
  const PathProblem problem{.space = Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)),
                            .allValid = eachColumn(onPath),
                            .start = path.col(0),
                            .goal = path.col(3)};
  const SplineResult result = splineAlong(problem, path, limitsOf(2));
  EXPECT_EQ(result.status, SplineStatus::kStops) << result.message;
  EXPECT_GE(result.stops, 2);
  EXPECT_NEAR(expectValid(problem, result.spline), 1.3, 1e-6);
  expectTwiceDifferentiable(result.spline);
}

TEST(PathSpline, SaysWhenThePathItselfIsNotValid) {
  const PathProblem problem = wallWithHole(2, .1);
  Eigen::MatrixXd through(2, 2);
  through << problem.start, problem.goal;
  const SplineResult result = splineAlong(problem, through, limitsOf(2));
  EXPECT_EQ(result.status, SplineStatus::kInvalid);
  EXPECT_EQ(result.spline.control().cols(), 0);
  EXPECT_EQ(result.message, "no spline: the path itself is not valid");
}

TEST(PathSpline, TurnsTheShorterWayRoundAndRestsAtASinglePoint) {
  const PathProblem problem{.space = Space::se2({0, 0}, {1, 1}),
                            .allValid = eachColumn([](const VectorArg&) { return true; })};
  Eigen::MatrixXd path(3, 2);
  path << .1, .9, .5, .5, 3, -3;
  const PathSpline spline = splineAlong(problem, path, limitsOf(3)).spline;
  EXPECT_NEAR(spline.position(spline.duration() / 2)[2], M_PI, 1e-12);
  EXPECT_NEAR(spline.position(spline.duration())[2], 2 * M_PI - 3, 1e-12);
  const PathSpline point = splineAlong(problem, path.leftCols(1), limitsOf(3)).spline;
  EXPECT_EQ(point.duration(), 0);
  EXPECT_EQ(point.position(1), path.col(0));
  EXPECT_TRUE(point.velocity(0).isZero());
}

TEST(PathSpline, RefusesWhatItCannotFollow) {
  const PathProblem problem = wallWithHole(2, .3);
  const Eigen::MatrixXd path = Eigen::MatrixXd::Constant(2, 2, .1);
  const auto spline = [&](const Eigen::MatrixXd& along, const MotionLimits& limits) {
    static_cast<void>(splineAlong(problem, along, limits));
  };
  EXPECT_REX_ERROR(spline(Eigen::MatrixXd(2, 0), limitsOf(2)),
                   "path: found no configurations, wanted at least one");
  EXPECT_REX_ERROR(spline(Eigen::MatrixXd::Zero(3, 2), limitsOf(2)),
                   "configurations of a path: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(spline(path, {.velocity = Eigen::Vector2d(1, 0)}),
                   "limits of velocity: found 0, wanted positive, finite numbers");
  EXPECT_REX_ERROR(spline(path, {.velocity = Eigen::Vector2d(1, INFINITY)}),
                   "limits of velocity: found inf, wanted positive, finite numbers");
  EXPECT_REX_ERROR(spline(path, limitsOf(3)), "limits of velocity: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(spline(path, {.velocity = Eigen::Vector2d(1, 1), .acceleration = Eigen::Vector2d(1, NAN)}),
                   "limits of acceleration: found nan, wanted positive, finite numbers");
  PathProblem floating = problem;
  floating.space = Space::se3({0, 0, 0}, {1, 1, 1});
  EXPECT_REX_ERROR(static_cast<void>(splineAlong(floating, Eigen::MatrixXd::Zero(7, 2), limitsOf(7))),
                   "space of a spline: found quaternions, wanted lines and angles alone");
}

// The middle of three steps, of which only that one moves, is 3/4 as fast as the step.
TEST(PathSpline, IsAsFastAsItMayOnAStraightWay) {
  const PathProblem problem = wallWithHole(2, .2);
  Eigen::MatrixXd path(2, 2);
  path << .1, .4, .1, .1;
  const PathSpline spline = splineAlong(problem, path, {.velocity = Eigen::Vector2d(.5, .5)}).spline;
  EXPECT_NEAR(spline.duration(), 3 * .75 * .3 / .5, 1e-12);
  EXPECT_NEAR(spline.velocity(spline.duration() / 2)[0], .5, 1e-12);
}

TEST(PathSpline, AsksInSmallBlocks) {
  PathProblem problem = wallWithHole(2, .2);
  problem.resolution = 1e-4;
  Eigen::Index widest = 0, asked = 0;
  problem.allValid = [&](const MatrixArg& Q) {
    widest = std::max(widest, Q.cols());
    asked += Q.cols();
    return true;
  };
  Eigen::MatrixXd corner(2, 3);
  corner << .1, .3, .3, .1, .1, .4;
  EXPECT_EQ(splineAlong(problem, corner, limitsOf(2)).status, SplineStatus::kSmooth);
  EXPECT_GT(asked, 8000);
  EXPECT_LE(widest, 8);
}

TEST(PathSpline, RefusesTimesAndSplinesThatAreNone) {
  const PathSpline point(Eigen::MatrixXd::Zero(2, 6), 1);
  for (const double t : {static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_REX_ERROR(static_cast<void>(point.position(t)), "time on a spline: found");
  EXPECT_REX_ERROR(static_cast<void>(PathSpline().velocity(0)),
                   "spline: found no control points, wanted one that splineAlong() found");
  EXPECT_REX_ERROR(PathSpline(Eigen::MatrixXd(2, 0), 1), "spline: found no control points");
  EXPECT_REX_ERROR(PathSpline(Eigen::MatrixXd::Zero(2, 6), NAN),
                   "interval of a spline: found nan s, wanted a finite time, zero or more");
}

}  // namespace rex::path_spline_test
