#include "estimation/consistency.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "random_gaussian.h"
#include "support/expect_error.h"

namespace rex::consistency_test {

using std::numbers::pi;

// Values of printed tables (Abramowitz and Stegun, table 26.8).
TEST(Consistency, ChiSquareIsThatOfTheTables) {
  EXPECT_NEAR(chiSquareQuantile(.95, 1), 3.84146, 1e-5);
  EXPECT_NEAR(chiSquareQuantile(.95, 2), 5.99146, 1e-5);
  EXPECT_NEAR(chiSquareQuantile(.05, 10), 3.94030, 1e-5);
  EXPECT_NEAR(chiSquareQuantile(.975, 100), 129.561, 1e-3);
  EXPECT_NEAR(chiSquareQuantile(.005, 30), 13.7867, 1e-4);
}

// Two degrees are an exponential distribution, one degree is a squared normal.
TEST(Consistency, ChiSquareFollowsClosedForms) {
  for (double x = .01; x < 60; x *= 1.3) {
    EXPECT_NEAR(chiSquareProbability(x, 2), 1 - std::exp(-x / 2), 1e-14);
    EXPECT_NEAR(chiSquareProbability(x, 1), std::erf(std::sqrt(x / 2)), 1e-14);
    EXPECT_NEAR(chiSquareProbability(x, 4), 1 - std::exp(-x / 2) * (1 + x / 2), 1e-14);
  }
  for (const double p : {1e-6, .2, .5, .999, 1 - 1e-9})
    for (const double k : {.5, 1., 3., 40., 5000.})
      EXPECT_NEAR(chiSquareProbability(chiSquareQuantile(p, k), k), p, 1e-11);
}

TEST(Consistency, ErrorsOfGaussiansAreChiSquare) {
  Rng rng(5);
  const Gaussian belief = test::randomGaussian(3, rng);
  const int runs = 4000;
  double mean = 0;
  for (int i = 0; i < runs; ++i) mean += estimationErrorSquared(belief, sample(belief, rng)) / runs;
  const ConsistencyBand band = consistencyBand(runs, 3, 1 - 1e-5);
  EXPECT_GT(mean, band.lower);
  EXPECT_LT(mean, band.upper);
  EXPECT_LT(band.upper - band.lower, .4);
}

TEST(Consistency, AnglesAreComparedTheShorterWay) {
  const Gaussian belief{Eigen::Vector2d(0, 3.1), Eigen::Matrix2d::Identity()};
  const int angles[] = {1};
  EXPECT_NEAR(estimationErrorSquared(belief, Eigen::Vector2d(0, -3.1), angles), std::pow(2 * pi - 6.2, 2),
              1e-12);
}

TEST(Consistency, TrajectoriesAreAlignedFirst) {
  Rng rng(6);
  Eigen::MatrixXd truth(2, 50), turned(2, 50);
  for (int t = 0; t < 50; ++t) truth.col(t) = rng.normalVector(2);
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(1.2).toRotationMatrix();
  turned = (R * truth).colwise() + Eigen::Vector2d(3, -4);
  EXPECT_LT(absoluteTrajectoryError(turned, truth), 1e-12);
  turned.row(0) *= -1;
  EXPECT_GT(absoluteTrajectoryError(turned, truth), .3) << "a mirror image is another path";
  // Alternating offsets across a long line stay when the line is aligned.
  Eigen::MatrixXd line(3, 100), shaken;
  for (int t = 0; t < 100; ++t) line.col(t) = Eigen::Vector3d(t, 0, 0);
  shaken = line;
  for (int t = 0; t < 100; ++t) shaken(1, t) += t % 2 == 0 ? .1 : -.1;
  EXPECT_NEAR(absoluteTrajectoryError(shaken, line), .1, 1e-3);
}

TEST(Consistency, RelativeErrorsAreThoseOfSteps) {
  Eigen::MatrixXd truth(3, 11), estimate(3, 11);
  for (int t = 0; t < 11; ++t) {
    truth.col(t) << t, 0, 0;
    estimate.col(t) << std::sin(.1 * t) / .1, (1 - std::cos(.1 * t)) / .1, .1 * t;  // drifts along an arc
  }
  const double chord = 2 * std::sin(.05) / .1;
  const RelativeError step = relativePoseError(estimate, truth);
  EXPECT_NEAR(step.rotation, .1, 1e-12);
  EXPECT_NEAR(step.translation, std::hypot(chord * std::cos(.05) - 1, chord * std::sin(.05)), 1e-12);
  EXPECT_NEAR(relativePoseError(estimate, truth, 5).rotation, .5, 1e-12);
}

TEST(Consistency, SaysWhatIsWrong) {
  EXPECT_REX_ERROR(chiSquareQuantile(1, 2), "probability: found 1, wanted between 0 and 1");
  EXPECT_REX_ERROR(chiSquareProbability(1, 0),
                   "degrees of freedom: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(consistencyBand(5, 2, 1), "probability: found 1, wanted between 0 and 1");
  EXPECT_REX_ERROR(chiSquareProbability(std::nan(""), 2), "chi-square number: found nan");
  EXPECT_EQ(chiSquareProbability(INFINITY, 2), 1);
  const Gaussian round{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()};
  const int none[] = {-1}, beyond[] = {2};
  EXPECT_REX_ERROR(estimationErrorSquared(round, Eigen::Vector2d(0, 0), none),
                   "angle among the numbers: found number -1");
  EXPECT_REX_ERROR(estimationErrorSquared(round, Eigen::Vector2d(0, 0), beyond),
                   "found number 2, wanted 0 to 1");
  EXPECT_REX_ERROR(estimationErrorSquared(round, Eigen::Vector2d(0, NAN)), "truth: number 1: found nan");
  EXPECT_REX_ERROR(estimationErrorSquared(round, Eigen::Vector3d(0, 0, 0)),
                   "truth: found a vector of size 3");
  EXPECT_REX_ERROR(consistencyBand(0, 2), "runs: found 0, wanted at least 1");
  const Eigen::MatrixXd planar = Eigen::MatrixXd::Zero(3, 4), empty(2, 0);
  EXPECT_REX_ERROR(relativePoseError(planar, planar, 4),
                   "steps of the relative error: found 4, wanted 1 to 3");
  EXPECT_REX_ERROR(relativePoseError(planar.leftCols(3), planar),
                   "estimated poses: found a vector of size 3");
  EXPECT_REX_ERROR(absoluteTrajectoryError(empty, empty), "trajectory: found no positions");
  const Gaussian flat{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Zero()};
  EXPECT_REX_ERROR(estimationErrorSquared(flat, Eigen::Vector2d(0, 0)), "covariance: found the eigenvalue 0");
}

}  // namespace rex::consistency_test
