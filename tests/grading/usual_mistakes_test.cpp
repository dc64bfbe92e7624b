#include "grading/usual_mistakes.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"

namespace rex::grading::usual_mistakes_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kTight = 1e-6;

Eigen::MatrixXd randomMatrix(Rng& rng, Eigen::Index rows, Eigen::Index cols) {
  return Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return rng.normal(); });
}

Eigen::MatrixXd one(double value) { return Eigen::MatrixXd::Constant(1, 1, value); }

TEST(UsualMistake, NamesEachOfThem) {
  Rng rng(1);
  const Eigen::MatrixXd A = randomMatrix(rng, 3, 3), v = randomMatrix(rng, 3, 1),
                        path = randomMatrix(rng, 9, 2);
  EXPECT_THAT(usualMistake(-v, v, kTight), HasSubstr("opposite sign"));
  EXPECT_THAT(usualMistake(A.transpose(), A, kTight), HasSubstr("transposed"));
  EXPECT_THAT(usualMistake(path.transpose(), path, kTight), HasSubstr("transposed"));
  Eigen::MatrixXd nearly = A + A.transpose();
  nearly(0, 1) += 2e-5;
  EXPECT_EQ(usualMistake(nearly, nearly.transpose(), 1e-7), "") << "that is a test of symmetry";
  EXPECT_THAT(usualMistake(one(90), one(std::numbers::pi / 2), kTight, "rad"), HasSubstr("is in degrees"));
  EXPECT_THAT(usualMistake(one(std::numbers::pi / 2), one(90), kTight, "deg"), HasSubstr("is in radians"));
  EXPECT_THAT(usualMistake(v / 7, v, kTight),
              StartsWith("Your value is 0.1429 times the wanted one, in every"));
  EXPECT_THAT(usualMistake(one(0.5), one(0.25), kTight), StartsWith("Your value is 2 times the wanted one:"));
  EXPECT_THAT(usualMistake(one(0.3 * std::sqrt(2 * std::numbers::pi)), one(0.3), kTight),
              HasSubstr("the root of 2 pi"));
  EXPECT_THAT(usualMistake(v.colwise().reverse(), v, kTight), HasSubstr("reverse order"));
  Eigen::MatrixXd exchanged = v;
  exchanged.row(0).swap(exchanged.row(1));
  EXPECT_THAT(usualMistake(exchanged, v, kTight), HasSubstr("first two entries exchanged"));
  Eigen::MatrixXd ahead = path, behind = path;
  ahead.topRows(8) = path.bottomRows(8);
  behind.bottomRows(8) = path.topRows(8);
  EXPECT_THAT(usualMistake(ahead, path, kTight), HasSubstr("one step ahead"));
  EXPECT_THAT(usualMistake(behind, path, kTight), HasSubstr("one step behind"));
  EXPECT_THAT(usualMistake(ahead.transpose(), path.transpose(), kTight), HasSubstr("one column later"));
}

TEST(UsualMistake, SaysNothingByAccident) {
  Rng rng(2);
  for (int k = 0; k < 10000; ++k) {
    const Eigen::Index rows = 1 + k % 6, cols = 1 + k % 3;
    const Eigen::MatrixXd got = randomMatrix(rng, rows, cols), wanted = randomMatrix(rng, rows, cols);
    EXPECT_EQ(usualMistake(got, wanted, 1e-6 * wanted.cwiseAbs().maxCoeff(), "rad"), "");
  }
}

TEST(UsualMistake, SaysNothingWhereItCannotBeTold) {
  const Eigen::Vector3d v(0.1, -0.2, 0.3), zero = Eigen::Vector3d::Zero();
  EXPECT_EQ(usualMistake(-v, v, 0.01), "") << "a wide tolerance";
  EXPECT_EQ(usualMistake(v, zero, kTight), "") << "nothing is wanted";
  EXPECT_EQ(usualMistake(zero, v, kTight), "") << "nothing was done";
  EXPECT_EQ(usualMistake(v + Eigen::Vector3d::Constant(5e-6), v, kTight), "") << "inexact";
  EXPECT_EQ(usualMistake(one(1 + 1e-12), one(1), 0), "") << "rounding";
  EXPECT_EQ(usualMistake(one(4), one(2), 0), "") << "counts";
  EXPECT_EQ(usualMistake(one(0.3), one(0.1), kTight), "") << "three times is nothing usual";
  EXPECT_EQ(usualMistake(Eigen::MatrixXd(0, 3), Eigen::MatrixXd(0, 3), 0), "");
  EXPECT_EQ(usualMistake(Eigen::Vector2d(1, 2), v, kTight), "") << "another size";
}

TEST(StrangeNumber, IsNamed) {
  EXPECT_EQ(strangeNumber(Eigen::Vector3d(0, 1.1e-313, -1e100)), "");
  EXPECT_EQ(strangeNumber(Eigen::Vector2d(1, -5.4861e303)),
            "Numbers such as -5.49e+303 come from memory that was never set, or is gone.");
  EXPECT_EQ(strangeNumber(Eigen::Vector2d(1, -std::nan(""))),
            "Numbers such as nan come from memory that was never set, or is gone.");
}

}  // namespace rex::grading::usual_mistakes_test
