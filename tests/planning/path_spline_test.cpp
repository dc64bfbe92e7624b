#include "planning/path_spline.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/rrt.h"
#include "planning/smooth_path.h"
#include "planning/wall.h"
#include "support/expect_error.h"

namespace rex::path_spline_test {

Eigen::MatrixXd shortPath(const PathProblem& problem, std::uint64_t seed) {
  Rng rng(seed);
  return shortcut(problem, connectRrts(problem, {.stepSize = .1}, rng).path, 100, rng);
}

// Values against differences of those they derive from, also across the joints of the pieces, where each has
// a value from either side.
void expectTwiceDifferentiable(const PathSpline& spline) {
  constexpr double kStep = 1e-6;
  const double scale = spline.control().cwiseAbs().maxCoeff() + 1;
  for (double s = .25; s <= spline.length(); s += .25) {
    const Eigen::VectorXd before = spline.value(s - kStep), after = spline.value(s + kStep);
    if (s < spline.length()) {
      EXPECT_LT((spline.value(s, 1) - (after - before) / (2 * kStep)).norm(), 1e-7 * scale);
      const Eigen::VectorXd slower = spline.value(s - kStep, 1), faster = spline.value(s + kStep, 1);
      EXPECT_LT((spline.value(s, 2) - (faster - slower) / (2 * kStep)).norm(), 1e-3);
    }
    EXPECT_LT((spline.value(s - 1e-9, 2) - spline.value(s + 1e-9, 2)).norm(), 1e-5) << "a jump";
  }
}

// The curve has the same points in the same order, goes on where a piece ends, in the same direction unless
// it stops there, and its derivatives are those of its points.
void expectSamePoints(const PathSpline& spline, const PathCurve& curve) {
  CurvePoint before, after, here;
  double longest = 0;
  for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
    const CurvePiece& piece = curve.pieces[i];
    piece.at(0, after);
    if (i > 0) {
      EXPECT_LT((after.q - before.q).norm(), 1e-12);
      if (!curve.pieces[i - 1].stopsAtEnd) {
        EXPECT_LT((after.dq - before.dq).norm(), 1e-12);
      }
    }
    for (const double share : {.2, .5, .8}) {
      constexpr double kStep = 1e-6;
      piece.at(share * piece.length - kStep, before);
      piece.at(share * piece.length + kStep, after);
      piece.at(share * piece.length, here);
      EXPECT_GT(here.dq.norm(), 0);
      EXPECT_LT(((after.q - before.q) / (2 * kStep) - here.dq).norm(), 1e-7);
      EXPECT_LT(((after.dq - before.dq) / (2 * kStep) - here.ddq).norm(), 1e-7);
      double nearest = 1;
      for (double s = longest; s <= spline.length() && nearest > 1e-4; s += 1e-4) {
        const double distance = (spline.value(s) - here.q).norm();
        if (distance < nearest) nearest = distance, longest = s;
      }
      EXPECT_LT(nearest, 1e-4) << "piece " << i;
    }
    piece.at(piece.length, before);
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
  Eigen::VectorXd last = spline.value(0);
  constexpr int kPoints = 20000;
  for (int i = 1; i <= kPoints; ++i) {
    const Eigen::VectorXd q = spline.value(spline.length() * i / kPoints);
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
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
      const Eigen::MatrixXd path = shortPath(thick, seed);
      const SplineResult result = splineAlong(thick, path);
      ASSERT_NE(result.status, SplineStatus::kInvalid) << result.message;
      EXPECT_EQ(result.status == SplineStatus::kSmooth, result.stops == 0);
      smooth += result.stops == 0 ? 1 : 0;
      const PathSpline& spline = result.spline;
      EXPECT_LT((spline.value(0) - problem.start).norm(), 1e-15);
      EXPECT_LT((spline.value(spline.length()) - problem.goal).norm(), 1e-15);
      EXPECT_LE(expectValid(problem, spline), pathLength(problem.space, path) + 1e-9);
      expectTwiceDifferentiable(spline);
      const PathCurve curve = spline.curve();
      EXPECT_EQ(curve.stops(), result.stops);
      if (seed < 4) expectSamePoints(spline, curve);
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
  const SplineResult result = splineAlong(problem, corner);
  EXPECT_EQ(result.status, SplineStatus::kSmooth);
  EXPECT_EQ(result.spline.control().cols(), 7);
  EXPECT_NE(result.message.find("7 control points and 0 stops"), std::string::npos) << result.message;
  // A third of the corner, a sixth of each neighbour: the middle of a uniform cubic B-spline.
  const Eigen::Vector2d middle = (corner.col(0) + 4 * corner.col(1) + corner.col(2)) / 6;
  EXPECT_LT((result.spline.value(result.spline.length() / 2) - middle).norm(), 1e-12);
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
  const SplineResult result = splineAlong(problem, path);
  EXPECT_EQ(result.status, SplineStatus::kStops) << result.message;
  EXPECT_GE(result.stops, 2);
  EXPECT_NEAR(expectValid(problem, result.spline), 1.3, 1e-6);
  EXPECT_EQ(result.spline.curve().stops(), result.stops);
  expectSamePoints(result.spline, result.spline.curve());
  expectTwiceDifferentiable(result.spline);
}

TEST(PathSpline, SaysWhenThePathItselfIsNotValid) {
  const PathProblem problem = wallWithHole(2, .1);
  Eigen::MatrixXd through(2, 2);
  through << problem.start, problem.goal;
  const SplineResult result = splineAlong(problem, through);
  EXPECT_EQ(result.status, SplineStatus::kInvalid);
  EXPECT_EQ(result.spline.control().cols(), 0);
  EXPECT_EQ(result.message, "no spline: the path itself is not valid");
}

TEST(PathSpline, TurnsTheShorterWayRoundAndRestsAtASinglePoint) {
  const PathProblem problem{.space = Space::se2({0, 0}, {1, 1}),
                            .allValid = eachColumn([](const VectorArg&) { return true; })};
  Eigen::MatrixXd path(3, 2);
  path << .1, .9, .5, .5, 3, -3;
  const PathSpline spline = splineAlong(problem, path).spline;
  EXPECT_NEAR(spline.value(spline.length() / 2)[2], M_PI, 1e-12);
  EXPECT_NEAR(spline.value(spline.length())[2], 2 * M_PI - 3, 1e-12);
  const PathSpline point = splineAlong(problem, path.leftCols(1)).spline;
  EXPECT_TRUE(point.curve().pieces.empty());
  EXPECT_EQ(point.curve().start, path.col(0));
  EXPECT_LT((point.value(1) - path.col(0)).norm(), 1e-15);
  EXPECT_LT(point.value(1, 1).norm(), 1e-15);
}

TEST(PathSpline, RefusesWhatItCannotFollow) {
  const PathProblem problem = wallWithHole(2, .3);
  EXPECT_REX_ERROR(static_cast<void>(splineAlong(problem, Eigen::MatrixXd(2, 0))),
                   "path: found no configurations, wanted at least one");
  EXPECT_REX_ERROR(static_cast<void>(splineAlong(problem, Eigen::MatrixXd::Zero(3, 2))),
                   "configurations of a path: found a vector of size 3, wanted size 2");
  PathProblem floating = problem;
  floating.space = Space::se3({0, 0, 0}, {1, 1, 1});
  EXPECT_REX_ERROR(static_cast<void>(splineAlong(floating, Eigen::MatrixXd::Zero(7, 2))),
                   "space of a spline: found quaternions, wanted only lines and angles");
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
  EXPECT_EQ(splineAlong(problem, corner).status, SplineStatus::kSmooth);
  EXPECT_GT(asked, 8000);
  EXPECT_LE(widest, 8);
}

TEST(PathSpline, RefusesParametersAndSplinesThatAreNone) {
  const PathSpline point(Eigen::MatrixXd::Zero(2, 6));
  for (const double s : {static_cast<double>(NAN), static_cast<double>(INFINITY)})
    EXPECT_REX_ERROR(static_cast<void>(point.value(s)), "parameter of a spline: found");
  EXPECT_REX_ERROR(static_cast<void>(PathSpline().value(0, 1)),
                   "spline: found no control points, wanted one that splineAlong() found");
  EXPECT_REX_ERROR(static_cast<void>(PathSpline().curve()), "spline: found no control points");
  EXPECT_REX_ERROR(PathSpline(Eigen::MatrixXd(2, 0)), "spline: found no control points, wanted at least one");
}

}  // namespace rex::path_spline_test
