#include "geometry/facet_hull.h"

#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "optim/linear_program.h"
#include "support/expect_error.h"

namespace rex::facet_hull_test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd randomMatrix(Rng& rng, int rows, int columns) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

// Every plane through d of the points that has all others behind it: normals in d rows, offsets in the last.
std::vector<VectorXd> planesByAllChoices(const MatrixXd& points) {
  const int d = static_cast<int>(points.rows()), n = static_cast<int>(points.cols());
  std::vector<VectorXd> planes;
  for (unsigned chosen = 0; chosen < 1u << n; ++chosen) {
    if (__builtin_popcount(chosen) != d) continue;
    MatrixXd through(d, d + 1);
    for (int j = 0, k = 0; j < n; ++j)
      if (chosen >> j & 1u) through.row(k++) << points.col(j).transpose(), -1;
    VectorXd plane = Eigen::FullPivLU<MatrixXd>(through).kernel().col(0);
    plane /= plane.head(d).norm();
    const VectorXd behind = plane[d] - (plane.head(d).transpose() * points).array();
    if (behind.minCoeff() < -1e-9) plane = -plane;
    if (behind.minCoeff() < -1e-9 && behind.maxCoeff() > 1e-9) continue;
    planes.push_back(plane);
  }
  return planes;
}

double distance(const VectorXd& plane, const FacetHull& hull) {
  const Index d = hull.normals.rows();
  return ((hull.normals.colwise() - plane.head(d)).colwise().norm().transpose() +
          (hull.offsets.array() - plane[d]).abs().matrix())
      .minCoeff();
}

TEST(FacetHull, HasTheFacetsThatAllChoicesOfPointsGive) {
  Rng rng(7);
  for (int trial = 0; trial < 60; ++trial) {
    const int d = 2 + trial % 5;
    const MatrixXd points = randomMatrix(rng, d, d + 1 + rng.index(6));
    const FacetHull hull = facetHull(points);
    const std::vector<VectorXd> planes = planesByAllChoices(points);
    ASSERT_EQ(hull.dimension, d);
    EXPECT_EQ(hull.normals.cols(), static_cast<Index>(planes.size())) << trial;
    for (const VectorXd& plane : planes) EXPECT_LT(distance(plane, hull), 1e-9) << trial;
  }
}

// How far from `start` a ray leaves the hull, by its facets and by a linear program over its points.
double exitByFacets(const FacetHull& hull, const VectorXd& start, const VectorXd& way) {
  const VectorXd speed = hull.normals.transpose() * way,
                 distance = hull.offsets - hull.normals.transpose() * start;
  double exit = HUGE_VAL;
  for (Index f = 0; f < speed.size(); ++f)
    if (speed[f] > 0) exit = std::min(exit, distance[f] / speed[f]);
  return exit;
}

double exitByProgram(const MatrixXd& points, const VectorXd& start, const VectorXd& way) {
  const Index d = points.rows(), n = points.cols();
  MatrixXd A(d + 1, n + 1);
  A << points.colwise() - start, -way, Eigen::RowVectorXd::Ones(n), 0;
  const LinearSolution solution = minimizeLinear(A, VectorXd::Unit(d + 1, d), -VectorXd::Unit(n + 1, n));
  EXPECT_EQ(solution.status, LinearStatus::kOptimal);
  return -solution.value;
}

// Thin along one axis, and half of the points all but twice.
TEST(FacetHull, OfThinPointsAndTwinsIsThatOfTheLinearProgram) {
  Rng rng(10);
  int full = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int d = 6, n = 18 + rng.index(16);
    VectorXd scale = VectorXd::Ones(d);
    scale[rng.index(d)] = std::pow(10, -rng.uniform(4, 8));
    const double apart = std::pow(10, -rng.uniform(9, 15));
    MatrixXd points = scale.asDiagonal() * randomMatrix(rng, d, n);
    for (int k = 0; k < n / 2; ++k) points.col(k) = points.col(n - 1 - k) + apart * rng.normalVector(d);
    const FacetHull hull = facetHull(points);
    if (hull.dimension < d) continue;
    ++full;
    const VectorXd middle = points.rowwise().mean();
    const MatrixXd wide = scale.cwiseInverse().asDiagonal() * points;
    for (int k = 0; k < 3; ++k) {
      const VectorXd way = rng.normalVector(d);
      const double exit = exitByProgram(wide, wide.rowwise().mean(), way);
      EXPECT_NEAR(exitByFacets(hull, middle, scale.asDiagonal() * way), exit, 1e-6 * exit)
          << trial << ": thin " << scale.minCoeff() << ", twins " << apart << " apart";
    }
    const double behind = ((hull.normals.transpose() * points).colwise() - hull.offsets).maxCoeff();
    EXPECT_LT(behind, 1e-13) << trial;
  }
  EXPECT_GT(full, 500);
}

TEST(FacetHull, MeasuresTheVolumesOfKnownBodies) {
  Rng rng(8);
  double factorial = 1;
  for (int d = 1; d <= 6; ++d) {
    factorial *= d;
    MatrixXd cross(d, 2 * d), cube(d, 1 << d), simplex = MatrixXd::Zero(d, d + 1);
    cross << MatrixXd::Identity(d, d), -MatrixXd::Identity(d, d);
    simplex.rightCols(d).setIdentity();
    for (int i = 0; i < d; ++i)
      for (int k = 0; k < 1 << d; ++k) cube(i, k) = k >> i & 1;
    const MatrixXd map = randomMatrix(rng, d, d);
    const VectorXd shift = rng.normalVector(d);
    const double scale = std::abs(map.determinant());
    EXPECT_NEAR(facetHull(cross).volume, std::pow(2, d) / factorial, 1e-12);
    EXPECT_NEAR(facetHull(simplex).volume, 1 / factorial, 1e-12);
    EXPECT_NEAR(facetHull(cube).volume, 1, 1e-12);
    EXPECT_NEAR(facetHull((map * cube).colwise() + shift).volume, scale, 1e-9 * scale);
    EXPECT_NEAR(facetHull((map * cross).colwise() + shift).volume, scale * std::pow(2, d) / factorial,
                1e-9 * scale);
  }
}

TEST(FacetHull, TellsHowManyDimensionsThePointsFill) {
  Rng rng(9);
  EXPECT_EQ(facetHull(MatrixXd(3, 0)).dimension, -1);
  for (int d = 1; d <= 6; ++d)
    for (int filled = 0; filled < d; ++filled) {
      const MatrixXd points =
          (randomMatrix(rng, d, filled) * randomMatrix(rng, filled, 12)).colwise() + rng.normalVector(d);
      const FacetHull hull = facetHull(points);
      EXPECT_EQ(hull.dimension, filled);
      EXPECT_EQ(hull.normals.cols(), 0);
      EXPECT_EQ(hull.volume, 0);
    }
  EXPECT_EQ(facetHull(MatrixXd::Constant(2, 5, 1e6)).dimension, 0);
}

TEST(FacetHull, RefusesBadPoints) {
  MatrixXd broken = MatrixXd::Zero(3, 5);
  broken(2, 4) = std::nan("");
  EXPECT_REX_ERROR(facetHull(broken), "hull: point 4: number 2: found nan");
  EXPECT_REX_ERROR(facetHull(MatrixXd(0, 5)), "hull: dimension of the points: found 0, wanted 1 to 9");
  EXPECT_REX_ERROR(facetHull(MatrixXd::Zero(10, 5)),
                   "hull: dimension of the points: found 10, wanted 1 to 9");
  EXPECT_REX_ERROR(facetHull(MatrixXd::Zero(2, 10'001)), "hull: found 10001 points, wanted at most 10000");
}

}  // namespace rex::facet_hull_test
