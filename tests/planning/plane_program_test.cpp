#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "optim/linear_program.h"
#include "planning/time_parametrization_internal.h"

namespace rex::plane_program_test {

using internal::HalfPlane;
using internal::largestX;
using internal::Range;
using internal::Slice;
using internal::smallestX;

// The same by the simplex method: x = xRange.low + p, y = yRange.low + r, and a slack for each row.
LinearSolution bySimplex(const std::vector<HalfPlane>& rows, const Range& x, const Range& y, double sign) {
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(count + 2, count + 4);
  Eigen::VectorXd b(count + 2), c = Eigen::VectorXd::Zero(count + 4);
  for (Eigen::Index i = 0; i < count; ++i) {
    const HalfPlane& row = rows[static_cast<std::size_t>(i)];
    A.row(i).head(2) << row.x, row.y;
    b[i] = row.bound - row.x * x.low - row.y * y.low;
  }
  A(count, 0) = A(count + 1, 1) = 1;
  A.rightCols(count + 2).setIdentity();
  b.tail(2) << x.high - x.low, y.high - y.low;
  c[0] = -sign;
  return minimizeLinear(A, b, c);
}

TEST(PlaneProgram, AgreesWithTheSimplexMethod) {
  Rng rng(3);
  int infeasible = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<HalfPlane> rows(static_cast<std::size_t>(1 + rng.index(12)));
    for (HalfPlane& row : rows) row = {rng.normal(), rng.normal(), rng.uniform(-.5, 1)};
    if (i % 7 == 0) rows.front().y = 0;
    const Range x{rng.uniform(0, .5), rng.uniform(.5, 3)}, y{rng.uniform(0, .5), rng.uniform(.5, 3)};
    Slice failed;
    const auto largest = largestX(rows, x, y, failed), smallest = smallestX(rows, x, y, failed);
    const LinearSolution most = bySimplex(rows, x, y, 1), least = bySimplex(rows, x, y, -1);
    ASSERT_EQ(largest.has_value(), most.status == LinearStatus::kOptimal) << i;
    ASSERT_EQ(smallest.has_value(), largest.has_value()) << i;
    infeasible += largest ? 0 : 1;
    if (!largest) continue;
    EXPECT_NEAR(*largest, x.low - most.value, 1e-9) << i;
    EXPECT_NEAR(*smallest, x.low + least.value, 1e-9) << i;
  }
  EXPECT_GT(infeasible, 200);
  EXPECT_LT(infeasible, 1800);
}

TEST(PlaneProgram, TellsWhichRowsLeaveNothing) {
  const std::vector<HalfPlane> rows = {{1, 0, .25}, {0, 1, 9}, {-1, -1, -2}};  // y <= 1/4, x <= 9, x + y >= 2
  Slice failed;
  EXPECT_EQ(largestX(rows, {0, 5}, {0, 1}, failed), 5);
  EXPECT_EQ(smallestX(rows, {0, 5}, {0, 1}, failed), 1.75);
  EXPECT_FALSE(largestX(rows, {0, 1}, {0, 1}, failed));
  EXPECT_EQ(failed.high.row, 0);
  EXPECT_EQ(failed.low.row, 2);
}

TEST(PlaneProgram, TakesSingleValues) {
  Slice failed;
  EXPECT_EQ(largestX({}, {3, 3}, {0, 0}, failed), 3);
  EXPECT_EQ(smallestX({}, {0, 0}, {2, 2}, failed), 0);
  const std::vector<HalfPlane> impossible = {{0, 0, -1}};
  EXPECT_FALSE(largestX(impossible, {0, 1}, {0, 1}, failed));
  EXPECT_FALSE(smallestX(impossible, {0, 1}, {0, 1}, failed));
}

}  // namespace rex::plane_program_test
