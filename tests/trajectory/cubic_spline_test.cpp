#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"
#include "trajectory/splines.h"

namespace rex::cubic_spline_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Sample {
  VectorXd times = (VectorXd(5) << -1, 0.2, 0.5, 2, 2.7).finished();
  MatrixXd points{2, 5};

  explicit Sample(unsigned seed) {
    Rng rng(seed);
    for (double& x : points.reshaped()) x = rng.normal();
  }
};

TEST(CubicSpline, GoesThroughItsPoints) {
  const Sample sample(1);
  const CubicSpline spline(sample.times, sample.points);
  for (int i = 0; i < 5; ++i)
    EXPECT_LT((spline.value(sample.times[i]) - sample.points.col(i)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(spline.start(), -1);
  EXPECT_EQ(spline.end(), 2.7);
}

TEST(CubicSpline, HasItsDerivatives) {
  const Sample sample(2);
  const CubicSpline spline(sample.times, sample.points, {.startVelocity = Eigen::Vector2d(1, -1)});
  for (const double t : {-1.3, -0.9, 0., 0.35, 1.1, 2.5, 2.9}) {
    for (int k = 0; k < 3; ++k) {
      const JacobianCheck check = checkJacobian([&](const VectorXd& s) { return spline.value(s[0], k); },
                                                spline.value(t, k + 1), VectorXd::Constant(1, t));
      EXPECT_TRUE(check.ok) << t << ": " << check.message;
    }
  }
}

TEST(CubicSpline, HasContinuousAccelerationAndItsEnds) {
  const Sample sample(3);
  const Eigen::Vector2d start(1, -1);
  const CubicSpline spline(sample.times, sample.points, {.startVelocity = start});
  for (int i = 1; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double t = sample.times[i];
      EXPECT_LT((spline.value(t - 1e-12, k) - spline.value(t, k)).cwiseAbs().maxCoeff(), 1e-9);
    }
  }
  EXPECT_LT((spline.value(-1, 1) - start).norm(), 1e-14);
  EXPECT_LT(spline.value(2.7, 2).norm(), 1e-12);  // natural
}

TEST(CubicSpline, IsTheCubicThatItsPointsLieOn) {
  const auto cubic = [](double t) { return 1 + t * (2 - t * (3 - t)); };
  const auto slope = [](double t) { return VectorXd::Constant(1, 2 - 6 * t + 3 * t * t).eval(); };
  const VectorXd times = Sample(1).times;
  const CubicSpline spline(times, times.unaryExpr(cubic).transpose(),
                           {.startVelocity = slope(-1), .endVelocity = slope(2.7)});
  for (double t = -1.5; t < 3; t += 0.1) EXPECT_NEAR(spline.value(t)[0], cubic(t), 1e-12);
}

TEST(CubicSpline, IsStraightBetweenTwoPoints) {
  const CubicSpline spline(Eigen::Vector2d(0, 2), Eigen::RowVector2d(1, 5));
  EXPECT_NEAR(spline.value(0.5)[0], 2, 1e-15);
  EXPECT_NEAR(spline.value(0.5, 1)[0], 2, 1e-15);
}

TEST(CubicSpline, SaysWhatIsWrong) {
  const Eigen::Vector2d times(0, 1);
  const MatrixXd points = MatrixXd::Ones(3, 2);
  EXPECT_REX_ERROR(CubicSpline(Eigen::Vector3d(0, 1, 2), points),
                   "times of a spline: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(CubicSpline(VectorXd::Zero(1), points.leftCols(1)),
                   "points of a spline: found 1, wanted at least 2");
  EXPECT_REX_ERROR(CubicSpline(Eigen::Vector2d(0, std::nan("")), points),
                   "times of a spline: number 1: found nan");
  EXPECT_REX_ERROR(CubicSpline(times, points * std::nan("")), "points of a spline: number 0: found nan");
  EXPECT_REX_ERROR(CubicSpline(Eigen::Vector2d(1, 1), points),
                   "times of a spline: number 1: found 1 after 1, wanted a later one");
  EXPECT_REX_ERROR(CubicSpline(times, points, {.endVelocity = times}),
                   "velocity at an end of a spline: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(CubicSpline(times, points, {.startVelocity = Eigen::Vector3d(0, 0, std::nan(""))}),
                   "velocity at an end of a spline: number 2: found nan");
  EXPECT_REX_ERROR(CubicSpline(times, points).value(std::nan("")), "time on a spline: found nan");
  EXPECT_REX_ERROR(CubicSpline(times, points).value(0, 4),
                   "derivative of a cubic spline: found 4, wanted 0 to 3");
  EXPECT_REX_ERROR(CubicSpline(times, points).value(0, -1), "derivative of a cubic spline: found -1");
}

}  // namespace rex::cubic_spline_test
