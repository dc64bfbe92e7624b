#include "legacy/array.h"

#include <cmath>
#include <sstream>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "legacy/random.h"
#include "support/expect_error.h"

namespace rex::legacy::array_test {

arr randomMatrix(Rng& rng, uint rows, uint columns) {
  arr A(rows, columns);
  for (uint i = 0; i < rows; ++i)
    for (uint j = 0; j < columns; ++j) A(i, j) = rng.normal();
  return A;
}

TEST(Array, KnowsItsSize) {
  const arr nothing, x = ARR(1, 2.5, 3), A(2, 4);
  EXPECT_EQ(nothing.nd, 0u);
  EXPECT_EQ(nothing.N, 0u);
  EXPECT_EQ(x.nd, 1u);
  EXPECT_EQ(x.d0, 3u);
  EXPECT_EQ(x.N, 3u);
  EXPECT_EQ(A.nd, 2u);
  EXPECT_EQ(A.d0, 2u);
  EXPECT_EQ(A.d1, 4u);
  EXPECT_EQ(A.N, 8u);
}

TEST(Array, IsFilledByANumber) {
  arr q(3);
  q = 1.5;
  EXPECT_EQ(q(2), 1.5);
  EXPECT_EQ(q.N, 3u);
  q.setZero();
  EXPECT_EQ(sum(q), 0);
  q.clear();
  EXPECT_EQ(q.nd, 0u);
}

// Eigen on the same numbers is the second opinion.
TEST(Array, CalculatesAsEigenDoes) {
  Rng rng(1);
  for (int round = 0; round < 20; ++round) {
    const arr A = randomMatrix(rng, 4, 3), B = randomMatrix(rng, 3, 5), C = randomMatrix(rng, 4, 3);
    const arr x(rng.normalVector(3));
    const Eigen::MatrixXd a = A.matrix(), b = B.matrix(), c = C.matrix();
    EXPECT_TRUE((A * B).matrix().isApprox(a * b));
    EXPECT_TRUE((A * x).vector().isApprox(a * x.vector()));
    EXPECT_TRUE((~A * C).matrix().isApprox(a.transpose() * c));
    EXPECT_TRUE((x * ~x).matrix().isApprox(x.vector() * x.vector().transpose()));
    EXPECT_NEAR((~x * x).scalar(), x.vector().squaredNorm(), 1e-12);
    EXPECT_TRUE((2. * A - C / 4. + 1.).matrix().isApprox(((2 * a - c / 4).array() + 1).matrix()));
    EXPECT_TRUE((1. - A % C).matrix().isApprox((1 - a.array() * c.array()).matrix()));
    const arr S = ~A * A + eye(3);
    EXPECT_TRUE(inverse(S).matrix().isApprox(S.matrix().inverse()));
    EXPECT_TRUE(inverse_SymPosDef(S).matrix().isApprox(S.matrix().inverse()));
    EXPECT_TRUE(lapack_Ainv_b_sym(S, x).vector().isApprox(S.matrix().inverse() * x.vector()));
    EXPECT_NEAR(scalarProduct(x, S * x), x.vector().dot(S.matrix() * x.vector()), 1e-12);
    EXPECT_NEAR(length(x), x.vector().norm(), 1e-14);
    EXPECT_NEAR(sqrDistance(x, 2. * x), sumOfSqr(x), 1e-12);
    EXPECT_EQ(maxDiff(A, C), (a - c).cwiseAbs().maxCoeff());
  }
}

TEST(Array, GrowsByAppending) {
  arr x, A;
  x.append(1).append(ARR(2, 3));
  EXPECT_EQ(maxDiff(x, ARR(1, 2, 3)), 0);
  A.append(eye(2));
  A.append(2. * eye(2));
  A.append(ARR(7, 8));
  EXPECT_EQ(A.d0, 5u);
  EXPECT_EQ(A(3, 1), 2);
  EXPECT_EQ(A.last(), 8);
  A.append(arr());
  EXPECT_EQ(A.d0, 5u);
}

TEST(Array, WritesRows) {
  arr X(3, 2);
  X[1] = ARR(1, 2);
  X[2]() = X[1];
  X[2](0) += 5;
  X[0] += X[1];
  X[0] -= ARR(1, 1);
  EXPECT_EQ(maxDiff(X[0], ARR(0, 1)), 0);
  EXPECT_EQ(maxDiff(X[2], ARR(6, 2)), 0);
  X[1] = 4.;
  const arr& constant = X;
  EXPECT_EQ(sum(constant[1] + X[1]), 16);
}

TEST(Array, FindsItsSmallestAndLargestNumber) {
  const arr x = ARR(3, -1, 7, -1);
  EXPECT_EQ(x.minIndex(), 1u);
  EXPECT_EQ(x.maxIndex(), 2u);
  EXPECT_EQ(x.min(), -1);
  EXPECT_EQ(x.max(), 7);
}

TEST(Array, MakesDiagonals) {
  arr W;
  W.setDiag(3., 2);
  EXPECT_EQ(maxDiff(W, 3. * eye(2)), 0);
  W.setDiag(ARR(1, 2));
  EXPECT_EQ(maxDiff(W, diag(ARR(1, 2))), 0);
  EXPECT_EQ(maxDiff(zeros(2, 2) + W, W), 0);
  EXPECT_EQ(zeros(4).N, 4u);
}

TEST(Array, IsPrinted) {
  std::ostringstream text;
  arr A(2, 2);
  A[1] = ARR(1.5, -2);
  text << ARR(1, 2, .5) << A << arr();
  EXPECT_EQ(text.str(), "[1 2 0.5][0 0\n 1.5 -2][]");
}

TEST(Array, RefusesWhatDoesNotExist) {
  arr x = ARR(1, 2), A(2, 3), nothing;
  const arr& y = x;
  const arr& B = A;
  EXPECT_REX_ERROR(x(2), "index (2): found a vector of 2, wanted an index that exists");
  EXPECT_REX_ERROR(y(7), "index (7)");
  EXPECT_REX_ERROR(A(0), "index (0): found a matrix of 2 x 3");
  EXPECT_REX_ERROR(A(1, 3), "index (1, 3)");
  EXPECT_REX_ERROR(B(2, 0), "index (2, 0)");
  EXPECT_REX_ERROR(A[2], "index [2]");
  EXPECT_REX_ERROR(B[2], "index [2]");
  EXPECT_REX_ERROR(y[0], "index [0]: found a vector of 2");
  EXPECT_REX_ERROR(nothing.minIndex(), "minIndex: found an empty array, wanted one with numbers");
  EXPECT_REX_ERROR(nothing.maxIndex(), "maxIndex");
  EXPECT_REX_ERROR(nothing.last(), "last");
  EXPECT_REX_ERROR(nothing.matrix(), "arr: found an empty array");
  EXPECT_REX_ERROR(A.vector(), "arr: found a matrix of 2 x 3, wanted a vector");
  EXPECT_REX_ERROR(x.scalar(), "scalar: found a vector of 2, wanted an array of one number");
}

TEST(Array, RefusesSizesThatDoNotFit) {
  arr x = ARR(1, 2), A(2, 3);
  EXPECT_REX_ERROR(x + ARR(1, 2, 3),
                   "sizes of +: found a vector of 2 and a vector of 3, wanted the same size");
  EXPECT_REX_ERROR(x -= A, "sizes of -");
  EXPECT_REX_ERROR(x % A, "sizes of %");
  EXPECT_REX_ERROR(x * x, "wanted scalarProduct(x, y)");
  EXPECT_REX_ERROR(A * x, "sizes of a product: found a matrix of 2 x 3 times a vector of 2");
  EXPECT_REX_ERROR(A.append(x),
                   "append: found a vector of 2 after a matrix of 2 x 3, wanted rows of the same length");
  EXPECT_REX_ERROR(x.append(A), "append");
  EXPECT_REX_ERROR(A[0] = x, "sizes of a row and its new values");
  EXPECT_REX_ERROR(inverse(A), "inverse");
}

TEST(RandomNumbers, AreThoseOfTheSeed) {
  rnd.seed(3);
  arr x = randn(5), y(2, 3);
  rnd.seed(3);
  Rng rng(3);
  for (uint i = 0; i < 5; ++i) EXPECT_EQ(x(i), rng.normal());
  EXPECT_EQ(maxDiff(x, randn(5)), 0);
  rndUniform(y, 2, 4);
  EXPECT_GE(y.min(), 2);
  EXPECT_LT(y.max(), 4);
  rndUniform(y, 10, 10.5, true);
  EXPECT_GE(y.min(), 12);
  rndGauss(x, 0);
  EXPECT_EQ(length(x), 0);
  EXPECT_LT(rand(4).max(), 1);
  EXPECT_LT(rnd.num(3), 3u);
  EXPECT_GE(rnd.uni(), 0);
  EXPECT_TRUE(std::isfinite(rnd.gauss()));
}

}  // namespace rex::legacy::array_test
