#include "estimation/car_particles.h"

#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "base/rng.h"
#include "estimation/car_particles_kernel_internal.h"
#include "estimation/weights_kernel_internal.h"
#include "support/expect_error.h"

namespace rex::car_particles_test {

using Kind = LandmarkSensor::Kind;

const CarMotion kMotion{.tau = 0.5, .wheelbase = 1.7, .deviations = {0.1, 0.2, 0.05}};
const Eigen::Vector2d kControl(0.9, -0.3);

Eigen::VectorXd nextState(const Eigen::VectorXd& x) {
  const double way = kMotion.tau * kControl[0];
  return x + Eigen::Vector3d(way * std::cos(x[2]), way * std::sin(x[2]),
                             way / kMotion.wheelbase * std::tan(kControl[1]));
}

Eigen::MatrixXd someStates(int count, Rng& rng) {
  Eigen::MatrixXd X(3, count);
  for (int i = 0; i < count; ++i) X.col(i) = 3 * rng.normalVector(3);
  return X;
}

Eigen::MatrixXd moved(const CarMotion& motion, Eigen::MatrixXd X, std::uint64_t seed) {
  Rng rng(seed);
  Eigen::VectorXd logWeights = Eigen::VectorXd::Zero(X.cols());
  carProposal(motion, kControl)(X, logWeights, rng);
  EXPECT_EQ(logWeights, Eigen::VectorXd::Zero(X.cols()));
  return X;
}

TEST(CarParticles, MoveAsTheCarWithoutNoise) {
  Rng rng(1);
  CarMotion exact = kMotion;
  exact.deviations.setZero();
  for (const int count : {0, 1, 2, 3, 4, 5, 255, 256, 257, 600}) {
    const Eigen::MatrixXd X = someStates(count, rng), next = moved(exact, X, 2);
    for (int i = 0; i < count; ++i) ASSERT_LT((next.col(i) - nextState(X.col(i))).norm(), 1e-14) << i;
  }
}

// Mean and covariance of many draws: five deviations of each.
TEST(CarParticles, NoiseHasTheDeviationsGiven) {
  const int count = 100000;
  const Eigen::Vector3d start(1, 2, 0.4);
  const Eigen::MatrixXd next = moved(kMotion, start.replicate(1, count), 3);
  const Gaussian moments = momentsOf({next, Eigen::VectorXd::Constant(count, 1.0 / count)});
  const Eigen::Vector3d& deviations = kMotion.deviations;
  const Eigen::Vector3d error = (moments.mean - nextState(start)).cwiseQuotient(deviations);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 5 / std::sqrt(count));
  const Eigen::Matrix3d scaled =
      deviations.cwiseInverse().asDiagonal() * moments.covariance * deviations.cwiseInverse().asDiagonal();
  EXPECT_LT((scaled - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 5 * std::sqrt(2. / count));
}

TEST(CarParticles, SameSeedSameBytes) {
  Rng rng(4);
  const Eigen::MatrixXd X = someStates(301, rng);
  EXPECT_EQ(moved(kMotion, X, 5), moved(kMotion, X, 5));
  EXPECT_NE(moved(kMotion, X, 5), moved(kMotion, X, 6));
}

NonlinearModel observationOf(const LandmarkSensor& sensor, const Eigen::Matrix2Xd& landmarks) {
  const Eigen::Index count = landmarks.cols();
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(2 * count, 2 * count);
  for (Eigen::Index k = 0; k < count; ++k) W.block<2, 2>(2 * k, 2 * k) = sensor.W;
  return {.g =
              [=](const Eigen::VectorXd& x) {
                Eigen::VectorXd y(2 * count);
                for (Eigen::Index k = 0; k < count; ++k)
                  y.segment<2>(2 * k) = viewOf(sensor, x, landmarks.col(k)).y;
                return y;
              },
          .W = W,
          .difference =
              [=](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
                Eigen::VectorXd d(2 * count);
                for (Eigen::Index k = 0; k < count; ++k)
                  d.segment<2>(2 * k) = innovation(sensor, a.segment<2>(2 * k), b.segment<2>(2 * k));
                return d;
              }};
}

TEST(CarParticles, WeightsAreThoseOfTheObservationModel) {
  Rng rng(7);
  LandmarkSensor sensor;
  sensor.W << 0.3, 0.1, 0.1, 0.2;
  for (const Kind kind : {Kind::kCartesian, Kind::kRangeBearing})
    for (const int landmarkCount : {1, 2, 7}) {
      sensor.kind = kind;
      const Eigen::Matrix2Xd landmarks = 5 * someStates(landmarkCount, rng).topRows(2);
      const Eigen::VectorXd y = 4 * rng.normalVector(2 * landmarkCount);
      const Eigen::MatrixXd X = someStates(103, rng);
      Eigen::VectorXd got = rng.normalVector(103), expected = got;
      landmarkWeights(sensor, landmarks, y)(X, got);
      observationWeights(observationOf(sensor, landmarks), y)(X, expected);
      EXPECT_LT((got - expected).norm(), 1e-12 * expected.norm());
    }
}

TEST(CarParticles, RowsOfALargerMatrixAreTaken) {
  Rng rng(8);
  Eigen::MatrixXd large = Eigen::MatrixXd::Constant(5, 10, 17);
  large.topRows(3) = someStates(10, rng);
  const Eigen::MatrixXd X = large.topRows(3);
  Eigen::VectorXd logWeights = Eigen::VectorXd::Zero(10);
  Rng noise(9);
  carProposal(kMotion, kControl)(large.topRows(3), logWeights, noise);
  EXPECT_EQ(large.topRows(3), moved(kMotion, X, 9));
  EXPECT_EQ(large.bottomRows(2), Eigen::MatrixXd::Constant(2, 10, 17));
  Eigen::VectorXd a = logWeights, b = logWeights;
  const Weigh weigh = landmarkWeights({}, Eigen::Vector2d(3, 4), Eigen::Vector2d(1, 2));
  weigh(large.topRows(3), a);
  weigh(large.topRows(3).eval(), b);
  EXPECT_EQ(a, b);
}

// Both landmarks are seen without noise: the particles gather where the car is.
TEST(CarParticles, FilterFindsTheCar) {
  Rng rng(10);
  Eigen::Matrix2Xd landmarks(2, 2);
  landmarks << 10, -5, 3, 8;
  LandmarkSensor sensor;
  sensor.W = 0.25 * Eigen::Matrix2d::Identity();
  ParticleFilter filter(sampledParticles({Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}, 20000, rng),
                        {.resampling = Resampling::kSystematic});
  Eigen::VectorXd x = Eigen::Vector3d(0.5, -0.3, 0.8);
  for (int t = 0; t < 20; ++t) {
    x = nextState(x);
    ASSERT_FALSE(filter
                     .step(carProposal(kMotion, kControl),
                           landmarkWeights(sensor, landmarks, observationOf(sensor, landmarks).g(x)), rng)
                     .lost);
  }
  const Gaussian belief = momentsOf(filter.particles());
  const Eigen::Vector3d error = belief.mean - x;
  EXPECT_LT(error.dot(belief.covariance.inverse() * error), 1);
  EXPECT_LT(belief.covariance.trace(), 0.3);
}

TEST(CarParticles, RefuseWhatIsWrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(carProposal({.wheelbase = 0}, kControl),
                   "wheelbase of the car: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(carProposal({.tau = nan}, kControl), "time step of the car: found nan");
  EXPECT_REX_ERROR(carProposal({.deviations = {0.1, -0.2, 0.1}}, kControl),
                   "deviations of the car's motion: number 1: found -0.2, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(carProposal({.deviations = {0.1, nan, 0.1}}, kControl),
                   "deviations of the car's motion: number 1: found nan");
  EXPECT_REX_ERROR(carProposal({}, {nan, 0}), "control of the car: number 0: found nan");

  const Eigen::Vector2d landmark(3, 4), y(1, 2);
  EXPECT_REX_ERROR(landmarkWeights({}, landmark, Eigen::Vector4d::Zero()),
                   "sightings: found a vector of size 4");
  EXPECT_REX_ERROR(landmarkWeights({}, landmark, Eigen::Vector2d(nan, 0)), "sightings: number 0: found nan");
  EXPECT_REX_ERROR(landmarkWeights({}, Eigen::Vector2d(0, nan), y), "landmarks: number 1: found nan");
  LandmarkSensor blurred;
  blurred.W.setZero();
  EXPECT_REX_ERROR(landmarkWeights(blurred, landmark, y), "noise of the sightings");
  blurred.W << 1, 5, 0, 1;
  EXPECT_REX_ERROR(landmarkWeights(blurred, landmark, y), "wanted a symmetric matrix");

  Rng rng(1);
  Eigen::MatrixXd planar = Eigen::MatrixXd::Zero(2, 4);
  Eigen::VectorXd logWeights = Eigen::VectorXd::Zero(4);
  EXPECT_REX_ERROR(carProposal({}, kControl)(planar, logWeights, rng),
                   "state of the car: found a vector of size 2");
  for (const Kind kind : {Kind::kCartesian, Kind::kRangeBearing})
    EXPECT_REX_ERROR(landmarkWeights({.kind = kind}, landmark, y)(planar, logWeights),
                     "state of the car: found a vector of size 2");
}

class ParticlesInLanes : public testing::TestWithParam<int> {};

TEST_P(ParticlesInLanes, HaveTheBitsOfOne) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  Rng rng(12);
  const int count = 1027;
  Eigen::MatrixXd X = someStates(count, rng);
  X(2, 17) = 3e5;  // lanes do not compute sines of such headings
  X(2, 18) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd normals = rng.normalVector(3 * count);
  const std::vector<internal::Sighting> sightings{{{3, 4}, {1, 2}, {2, 0.1, 1}},
                                                  {{-3, 1}, {0, 2}, {1, 0, 3}}};
  const auto computed = [&](int lanes) {
    const auto kernel = kernelFor<internal::CarParticlesKernel>(lanes);
    Eigen::MatrixXd next = X;
    Eigen::VectorXd logWeights = Eigen::VectorXd::Zero(count), weights(count);
    kernel.move({0.4, 0.1, {0.1, 0.2, 0.3}}, normals.data(), next.data(), 3, count);
    kernel.weigh(sightings.data(), 2, next.data(), 3, count, logWeights.data());
    EXPECT_TRUE(std::isnan(logWeights[18]));
    next.col(18).setZero();
    logWeights[18] = 0;
    const auto weighing = kernelFor<internal::WeightsKernel>(lanes);
    const double largest = weighing.largest(logWeights.data(), count, -HUGE_VAL);
    EXPECT_EQ(largest, logWeights.maxCoeff());
    const double sum = weighing.exponentials(logWeights.data(), largest, count, weights.data());
    EXPECT_NEAR(sum, weights.sum(), 1e-12 * sum);
    return std::tuple(next, logWeights, weights, sum);
  };
  EXPECT_EQ(computed(1), computed(GetParam()));
}

TEST_P(ParticlesInLanes, AddUpAndDivideToTheBit) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto one = kernelFor<internal::WeightsKernel>(1),
             many = kernelFor<internal::WeightsKernel>(GetParam());
  Rng rng(13);
  for (const int count : {1, 2, 3, 4, 5, 6, 7, 8, 11, 1000}) {
    const Eigen::VectorXd weights = rng.uniformVector(count, 0, 1);
    Eigen::VectorXd quotients(count), again(count);
    const auto sums = one.divide(weights.data(), 0.3, count, quotients.data());
    EXPECT_EQ(quotients, weights / 0.3);
    EXPECT_NEAR(sums.plain, quotients.sum(), 1e-13 * count);
    EXPECT_NEAR(sums.squared, quotients.squaredNorm(), 1e-13 * count);
    const auto sumsAgain = many.divide(weights.data(), 0.3, count, again.data());
    EXPECT_EQ(std::tuple(sums.plain, sums.squared), std::tuple(sumsAgain.plain, sumsAgain.squared));
    EXPECT_EQ(quotients, again);
  }
}

// A number that is not in range is seen wherever it is, and the least is in range.
TEST_P(ParticlesInLanes, SeeWhatIsOutOfRange) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto kernel = kernelFor<internal::WeightsKernel>(GetParam());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 7; ++i) {
    Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(7, 0, 6);
    EXPECT_EQ(kernel.largest(numbers.data(), 7, 0), 6);
    for (const double wrong : {nan, HUGE_VAL, -1e-300}) {
      numbers[i] = wrong;
      EXPECT_TRUE(std::isnan(kernel.largest(numbers.data(), 7, 0))) << i << ' ' << wrong;
    }
    numbers[i] = -HUGE_VAL;
    EXPECT_EQ(kernel.largest(numbers.data(), 7, -HUGE_VAL), i == 6 ? 5 : 6);
  }
}

INSTANTIATE_TEST_SUITE_P(TwoAndFour, ParticlesInLanes, testing::Values(2, 4));

}  // namespace rex::car_particles_test
