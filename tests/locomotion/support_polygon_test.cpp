#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/rng.h"
#include "geometry/convex_hull.h"
#include "locomotion/footsteps.h"
#include "support/expect_error.h"

namespace rex::support_polygon_test {

using Eigen::Matrix2Xd;
using Eigen::Vector2d;
using testing::HasSubstr;

Matrix2Xd points(std::initializer_list<Vector2d> list) {
  Matrix2Xd all(2, static_cast<Eigen::Index>(list.size()));
  Eigen::Index i = 0;
  for (const Vector2d& p : list) all.col(i++) = p;
  return all;
}

// Another hull, of the same points in single precision.
TEST(SupportPolygon, HasTheCornersOfTheHullInSpace) {
  Rng rng(1);
  for (int trial = 0; trial < 50; ++trial) {
    const int count = 3 + rng.index(40);
    std::vector<Eigen::Vector3f> cloud;
    Matrix2Xd flat(2, count);
    for (int i = 0; i < count; ++i) {
      cloud.emplace_back(static_cast<float>(rng.normal()), static_cast<float>(rng.normal()), 0.F);
      flat.col(i) = cloud.back().head<2>().cast<double>();
    }
    const SupportPolygon support = supportPolygon(flat);
    const TriangleMesh other = convexHull(cloud);
    ASSERT_EQ(support.shape, SupportShape::kPolygon);
    ASSERT_EQ(support.corners.cols(), static_cast<Eigen::Index>(other.positions().size()));
    for (const Eigen::Vector3f& corner : other.positions())
      EXPECT_EQ((support.corners.colwise() - corner.head<2>().cast<double>()).colwise().norm().minCoeff(), 0);
  }
}

TEST(SupportPolygon, OfTwoFeet) {
  const SupportPolygon support = supportPolygon(
      points({{0, 0}, {.2, 0}, {.2, .1}, {0, .1}, {0, .3}, {.2, .3}, {.2, .4}, {0, .4}, {.1, 0}, {.2, .4}}));
  ASSERT_EQ(support.shape, SupportShape::kPolygon);
  EXPECT_EQ(support.corners, points({{0, 0}, {.2, 0}, {.2, .4}, {0, .4}}));
  EXPECT_NEAR(support.area, .08, 1e-16);
  EXPECT_EQ(support.message, "");
}

// Contacts that kinematics places: corners twice, more of them along the edges, all with rounding.
TEST(SupportPolygon, HasNoCornersThatRoundingMakes) {
  Rng rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Rotation2Dd turn(rng.uniform(-M_PI, M_PI));
    const double length = std::pow(10, rng.uniform(-3, 3)), width = length * rng.uniform(.01, 1);
    Matrix2Xd contacts(2, 24);
    for (int i = 0; i < 24; ++i) {
      const double share = i % 3 / 2., s = i / 3 % 2;
      const bool isLong = i < 12;
      const Vector2d p(length * (isLong ? share : s), width * (isLong ? s : share));
      contacts.col(i) = turn * p + 1e-13 * length * rng.normalVector(2);
    }
    const SupportPolygon support = supportPolygon(contacts);
    ASSERT_EQ(support.shape, SupportShape::kPolygon);
    EXPECT_EQ(support.corners.cols(), 4) << trial;
    EXPECT_NEAR(support.area, length * width, 1e-10 * length * length);
  }
}

TEST(SupportPolygon, KeepsTheCornersOfNeedlesAndCircles) {
  EXPECT_EQ(supportPolygon(points({{0, 0}, {1, 0}, {.01, 2e-9}})).corners.cols(), 3);
  EXPECT_EQ(supportPolygon(points({{0, 0}, {1, 0}, {1, 1e-6}, {0, 1e-6}})).corners.cols(), 4);
  Matrix2Xd circle(2, 1000);
  for (int i = 0; i < 1000; ++i) circle.col(i) << std::cos(M_PI * i / 500), std::sin(M_PI * i / 500);
  EXPECT_EQ(supportPolygon(circle).corners.cols(), 1000);
}

TEST(SupportPolygon, SaysWhereThereIsNone) {
  const SupportPolygon none = supportPolygon(Matrix2Xd(2, 0));
  EXPECT_EQ(none.shape, SupportShape::kNone);
  EXPECT_EQ(none.message, "no support: there is no contact");
  const SupportPolygon point = supportPolygon(points({{1, 2}, {1, 2}, {1, 2}}));
  EXPECT_EQ(point.shape, SupportShape::kPoint);
  EXPECT_THAT(point.message, HasSubstr("one point"));
  const SupportPolygon two = supportPolygon(points({{1, 2}, {3, 2}}));
  EXPECT_EQ(two.shape, SupportShape::kLine);
  const double third = 1. / 3;
  const SupportPolygon line = supportPolygon(points({{0, 0}, {third, .1 * third}, {.7, .07}, {1, .1}}));
  EXPECT_EQ(line.shape, SupportShape::kLine);
  EXPECT_EQ(line.corners, points({{0, 0}, {1, .1}}));
  EXPECT_EQ(line.area, 0);
  EXPECT_THAT(line.message, HasSubstr("one line"));
  EXPECT_EQ(supportPolygon(points({{0, 0}, {1, 0}, {.5, 1e-6}})).shape, SupportShape::kPolygon);
  EXPECT_REX_ERROR(supportPolygon(points({{0, NAN}})), "support polygon: contact: number 1: found nan");
}

TEST(SupportMargin, IsTheDistanceToTheNearestEdge) {
  const SupportPolygon square = supportPolygon(points({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  const SupportMargin inside = supportMargin(square, {.4, .3});
  EXPECT_TRUE(inside.isInside);
  EXPECT_DOUBLE_EQ(inside.margin, .3);
  EXPECT_EQ(inside.nearest, Vector2d(.4, 0));
  EXPECT_EQ(inside.message, "inside by 0.3 m");
  const SupportMargin close = supportMargin(square, {.4, .3}, .31);
  EXPECT_FALSE(close.isInside);
  EXPECT_EQ(close.message, "inside by 0.3 m, wanted 0.31 m");
  const SupportMargin outside = supportMargin(square, {1.3, 1.4});
  EXPECT_FALSE(outside.isInside);
  EXPECT_DOUBLE_EQ(outside.margin, -.5);
  EXPECT_EQ(outside.nearest, Vector2d(1, 1));
  EXPECT_TRUE(supportMargin(square, {1, .5}).isInside);
  EXPECT_EQ(supportMargin(square, {1, .5}).margin, 0);
}

// Inside exactly if some mix of corners gives the point: here, if no separating direction among many does.
TEST(SupportMargin, AgreesWithSeparatingDirections) {
  Rng rng(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Matrix2Xd cloud = rng.normalVector(20).reshaped(2, 10);
    const Vector2d p = rng.normalVector(2);
    double least = std::numeric_limits<double>::infinity();  // of the support function over all directions
    for (int k = 0; k < 20000; ++k) {
      const double angle = 2 * M_PI * k / 20000;
      const Vector2d n(std::cos(angle), std::sin(angle));
      least = std::min(least, (n.transpose() * cloud).maxCoeff() - n.dot(p));
    }
    EXPECT_NEAR(supportMargin(supportPolygon(cloud), p).margin, least, 2e-3) << "trial " << trial;
  }
}

TEST(SupportMargin, WithoutAPolygonNothingIsInside) {
  const SupportMargin onLine = supportMargin(supportPolygon(points({{0, 0}, {2, 0}})), {1, 0});
  EXPECT_FALSE(onLine.isInside);
  EXPECT_EQ(onLine.margin, 0);
  EXPECT_THAT(onLine.message, HasSubstr("one line"));
  const SupportMargin beside = supportMargin(supportPolygon(points({{1, 1}})), {1, 3});
  EXPECT_FALSE(beside.isInside);
  EXPECT_EQ(beside.margin, -2);
  const SupportMargin nothing = supportMargin(supportPolygon(Matrix2Xd(2, 0)), {1, 3});
  EXPECT_FALSE(nothing.isInside);
  EXPECT_EQ(nothing.margin, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(nothing.message, "no support: there is no contact");
  EXPECT_REX_ERROR(supportMargin({}, {NAN, 0}), "support margin: point: number 0: found nan");
  EXPECT_REX_ERROR(supportMargin({}, {0, 0}, -1),
                   "support margin: wanted margin: found -1, wanted a finite number, 0 or more");
}

}  // namespace rex::support_polygon_test
