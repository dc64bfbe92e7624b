#include <cmath>

#include <gtest/gtest.h>

#include "formats/ors_reader.h"
#include "geometry/rotation.h"
#include "planning/path_spline.h"
#include "scene/state.h"
#include "support/expect_error.h"

namespace rex::path_curve_test {

const Space kPlane = Space::box(Eigen::Vector2d(-9, -9), Eigen::Vector2d(9, 9));

CurvePoint pointAt(const CurvePiece& piece, double s) {
  CurvePoint point;
  piece.at(s, point);
  return point;
}

TEST(StraightCurve, StopsOnlyAtCorners) {
  Eigen::MatrixXd path(2, 6);
  path << 0, 1, 3, 3, 3, 3, 0, 0, 0, 0, 4, 5;
  const PathCurve curve = straightCurve(kPlane, path);
  ASSERT_EQ(curve.pieces.size(), 4u) << "a posture that repeats has no piece";
  EXPECT_EQ(curve.stops(), 1);
  EXPECT_TRUE(curve.pieces[1].stopsAtEnd);
  EXPECT_DOUBLE_EQ(curve.length(), 8);
  const CurvePoint middle = pointAt(curve.pieces[2], 1);
  EXPECT_LT((middle.q - Eigen::Vector2d(3, 1)).norm(), 1e-12);
  EXPECT_EQ(middle.dq, Eigen::Vector2d(0, 1));
  EXPECT_TRUE(middle.ddq.isZero(0));
  EXPECT_EQ(pointAt(curve.pieces[3], 1).q, path.col(5));
  EXPECT_TRUE(straightCurve(kPlane, path.leftCols(1)).pieces.empty());
}

TEST(StraightCurve, TurnsQuaternionsAsVelocitiesOfTheModelDo) {
  const Model model =
      compile(parseOrs("body a {} body b {} body c {}\njoint slide (a b) { type=transX limits=[-5 5] }\n"
                       "joint ball (b c) { type=quatBall }\n",
                       "x.ors")
                  .spec);
  const Space space({{.lower = -5, .upper = 5}, {.kind = SpacePart::Kind::kQuaternion}});
  Eigen::MatrixXd path(5, 3);
  path << 0, 1, 2, Eigen::Vector4d(1, 0, 0, 0), Eigen::Vector4d(.8, .6, 0, 0), Eigen::Vector4d(.6, 0, .8, 0);
  const PathCurve curve = straightCurve(space, path);
  ASSERT_EQ(curve.pieces.size(), 2u);
  EXPECT_EQ(curve.stops(), 1);
  for (const CurvePiece& piece : curve.pieces)
    for (const double s : {0., .3 * piece.length, .9 * piece.length}) {
      constexpr double kStep = 1e-6;
      const CurvePoint here = pointAt(piece, s), next = pointAt(piece, s + kStep);
      EXPECT_LT((difference(model, here.q, next.q) / kStep - here.dq).norm(), 1e-6);
      EXPECT_LT((integrate(model, here.q, kStep * here.dq) - next.q).norm(), 1e-12);
    }
}

TEST(Sampled, StaysNearTheCurve) {
  const auto circle = [](double s, CurvePoint& point) {
    point.q = Eigen::Vector2d(std::cos(s), std::sin(s));
    point.dq = Eigen::Vector2d(-std::sin(s), std::cos(s));
    point.ddq = -point.q;
  };
  const PathCurve curve{.start = Eigen::Vector2d(1, 0), .pieces = {{.length = 3, .at = circle}}};
  const Eigen::MatrixXd postures = sampled(curve, 1e-4);
  ASSERT_GT(postures.cols(), 50);
  ASSERT_LT(postures.cols(), 200);
  for (Eigen::Index k = 1; k < postures.cols(); ++k) {
    const double farthest = 1 - (postures.col(k) + postures.col(k - 1)).norm() / 2;
    EXPECT_LT(farthest, 1.1e-4);
  }
  EXPECT_NEAR(postures(1, postures.cols() - 1), std::sin(3), 1e-15);
  Eigen::MatrixXd path(2, 3);
  path << 0, 1, 1, 0, 0, 1;
  EXPECT_EQ(sampled(straightCurve(kPlane, path), 1e-4), path);
  // On a line, at a speed that changes, and there and back.
  const auto square = [](double x, CurvePoint& point) {
    point = {Eigen::Vector2d(x * x, 2 * x * x), Eigen::Vector2d(2 * x, 4 * x), Eigen::Vector2d(2, 4)};
  };
  const auto on = [&](double s, CurvePoint& point) { square(s + 1, point); };
  const auto back = [&](double s, CurvePoint& point) { square(s - 1, point); };
  const Eigen::Vector2d start(1, 2);
  EXPECT_EQ(sampled({.start = start, .pieces = {{.length = 3, .at = on}}}, 1e-4).cols(), 2);
  const Eigen::MatrixXd turned = sampled({.start = start, .pieces = {{.length = 2, .at = back}}}, 1e-4);
  EXPECT_LT(turned.row(0).minCoeff(), 1e-3);
}

TEST(PathCurves, RefuseWhatIsNoPath) {
  EXPECT_REX_ERROR(static_cast<void>(straightCurve(kPlane, Eigen::MatrixXd(2, 0))),
                   "path: found no configurations, wanted at least one");
  EXPECT_REX_ERROR(static_cast<void>(straightCurve(kPlane, Eigen::MatrixXd::Zero(3, 2))),
                   "configurations of a path: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(static_cast<void>(sampled({.start = Eigen::Vector2d(0, 0)}, 0)),
                   "tolerance of a sampled curve: found 0, wanted a positive, finite number");
}

}  // namespace rex::path_curve_test
