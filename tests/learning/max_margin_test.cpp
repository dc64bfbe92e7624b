#include <limits>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "learning/inverse_rl.h"
#include "support/expect_error.h"

namespace rex::max_margin_test {

// The distance to the hull as the least over the hulls of all subsets, each by its own plane.
double distanceBySubsets(const Eigen::VectorXd& teacher, const Eigen::MatrixXd& candidates) {
  double best = 1e300;
  for (int subset = 1; subset < 1 << candidates.cols(); ++subset) {
    std::vector<Eigen::Index> corners;
    for (Eigen::Index i = 0; i < candidates.cols(); ++i)
      if (subset >> i & 1) corners.push_back(i);
    const Eigen::MatrixXd points = candidates(Eigen::all, corners).colwise() - teacher;
    const Eigen::Index count = points.cols();
    Eigen::MatrixXd M =
        Eigen::MatrixXd::Ones(count + 1, count + 1);  // stationarity, and shares that sum to 1
    M.topLeftCorner(count, count) = points.transpose() * points;
    M(count, count) = 0;
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(count + 1);
    rhs[count] = 1;
    const Eigen::VectorXd shares = M.completeOrthogonalDecomposition().solve(rhs).head(count);
    if (shares.minCoeff() >= -1e-9) best = std::min(best, (points * shares).norm());
  }
  return best;
}

TEST(MaxMargin, IsTheDistanceToTheHull) {
  Rng rng(1);
  int outside = 0;
  for (int round = 0; round < 300; ++round) {
    const int k = 1 + rng.index(4), count = 1 + rng.index(6);
    const Eigen::MatrixXd candidates = rng.normalVector(k * count).reshaped(k, count);
    const Eigen::VectorXd teacher = rng.normalVector(k);
    const MarginResult found = maxMargin(teacher, candidates);
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.margin, distanceBySubsets(teacher, candidates), 1e-9);
    EXPECT_NEAR(found.shares.sum(), 1, 1e-12);
    EXPECT_GE(found.shares.minCoeff(), 0);
    EXPECT_NEAR((candidates * found.shares - teacher).norm(), found.margin, 1e-11);
    if (found.margin == 0) continue;
    ++outside;
    EXPECT_NEAR(found.w.norm(), 1, 1e-14);
    EXPECT_NEAR((found.w.transpose() * (-(candidates.colwise() - teacher))).minCoeff(), found.margin, 1e-11);
  }
  EXPECT_GT(outside, 100);
  EXPECT_LT(outside, 295);
}

TEST(MaxMargin, TakesManyAndEqualCandidates) {
  Rng rng(2);
  Eigen::MatrixXd candidates = rng.normalVector(5 * 200).reshaped(5, 200);
  candidates.rightCols(100) = candidates.leftCols(100);
  const Eigen::VectorXd teacher = 5 * rng.normalVector(5);
  const MarginResult found = maxMargin(teacher, candidates);
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR((found.w.transpose() * (-(candidates.colwise() - teacher))).minCoeff(),
              (candidates * found.shares - teacher).norm(), 1e-10);
  // Tiny and large numbers alike.
  EXPECT_NEAR(maxMargin(1e-8 * teacher, 1e-8 * candidates).margin, 1e-8 * found.margin, 1e-18);
  const MarginResult same = maxMargin(teacher, teacher);
  EXPECT_EQ(same.margin, 0);
  EXPECT_EQ(same.w, Eigen::VectorXd::Zero(5));
}

TEST(MaxMargin, SaysWhenItIsNotThere) {
  Rng rng(3);
  const Eigen::MatrixXd candidates = rng.normalVector(5 * 50).reshaped(5, 50);
  EXPECT_FALSE(maxMargin(Eigen::VectorXd::Ones(5), candidates, 1).converged);
}

TEST(MaxMargin, RefusesWrongInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector2d teacher(1, 2);
  EXPECT_REX_ERROR(maxMargin(teacher, Eigen::MatrixXd(2, 0)), "candidates: found none");
  EXPECT_REX_ERROR(maxMargin(teacher, Eigen::Matrix3d::Zero()), "rows of the candidates");
  EXPECT_REX_ERROR(maxMargin(Eigen::Vector2d(nan, 0), teacher), "teacher: number 0: found nan");
  EXPECT_REX_ERROR(maxMargin(teacher, Eigen::Vector2d(0, nan)), "candidates: number 1: found nan");
}

}  // namespace rex::max_margin_test
