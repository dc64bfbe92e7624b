#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "control/care_doubling_internal.h"

namespace rex::internal::extended_matrix_test {

using Eigen::MatrixXd;

MatrixXd randomMatrix(Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return rng.uniform(-1, 1); });
}

TEST(ExtendedMatrix, MultipliesAsDoublesDo) {
  Rng rng(1);
  const MatrixXd A = randomMatrix(rng, 3, 5), B = randomMatrix(rng, 5, 2), C = randomMatrix(rng, 3, 2);
  EXPECT_LT((product(ExtendedMatrix(A), ExtendedMatrix(B)).rounded() - A * B).norm(), 1e-15);
  EXPECT_LT((transposedProduct(ExtendedMatrix(A), ExtendedMatrix(C)).rounded() - A.transpose() * C).norm(),
            1e-15);
  EXPECT_EQ(ExtendedMatrix(A).transpose().rounded(), A.transpose());
  EXPECT_NEAR(static_cast<double>(ExtendedMatrix(A).norm()), A.norm(), 1e-15);
  ExtendedMatrix sum(C);
  sum += ExtendedMatrix(C);
  EXPECT_EQ(sum.rounded(), 2 * C);
  sum -= ExtendedMatrix(C);
  EXPECT_EQ(sum.rounded(), C);
}

// Entries that doubles lose beside a one.
TEST(ExtendedMatrix, HasMoreDigitsThanDoubles) {
  ExtendedMatrix one(MatrixXd::Ones(1, 1));
  one += ExtendedMatrix(MatrixXd::Constant(1, 1, 1e-18));
  one -= ExtendedMatrix(MatrixXd::Ones(1, 1));
  EXPECT_NEAR(one.rounded()(0, 0), 1e-18, 1e-19);
}

// The inverse of Hilbert's matrix is known in closed form; its condition of 1.5e10 costs ten digits.
TEST(ExtendedMatrix, SolvesWhatIsNearlySingular) {
  constexpr int n = 8;
  const auto binomial = [](int a, int b) {
    double value = 1;
    for (int k = 1; k <= b; ++k) value = value * (a - b + k) / k;
    return std::round(value);
  };
  ExtendedMatrix H(n, n);
  MatrixXd inverse(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      H.column(j)[i] = 1.0L / static_cast<long double>(i + j + 1);
      inverse(i, j) = ((i + j) % 2 == 0 ? 1 : -1) * (i + j + 1.) * binomial(n + i, n - j - 1) *
                      binomial(n + j, n - i - 1) * std::pow(binomial(i + j, i), 2);
    }
  const MatrixXd solution = solved(H, ExtendedMatrix(MatrixXd::Identity(n, n))).rounded();
  EXPECT_LT((solution - inverse).norm(), 1e-8 * inverse.norm());
  EXPECT_FALSE(solved(ExtendedMatrix(2, 2), ExtendedMatrix(MatrixXd::Ones(2, 1))).rounded().allFinite());
}

// Rows have to change places.
TEST(ExtendedMatrix, SolvesWithAZeroOnTheDiagonal) {
  MatrixXd A(2, 2), b(2, 1);
  A << 0, 2, 4, 0;
  b << 6, 8;
  EXPECT_EQ(solved(ExtendedMatrix(A), ExtendedMatrix(b)).rounded(), Eigen::Vector2d(2, 3));
}

}  // namespace rex::internal::extended_matrix_test
