#include "control/racer_policy.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::racer_policy_test {

using Eigen::Matrix4Xd;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kTau = 0.01;
const RacerFeatures kAll{.rates = true, .averages = true, .averagedRates = true, .controls = true};

// The features at time t from the whole past, as sums; of averages the first value counts for all before it.
VectorXd featuresOf(const Matrix4Xd& y, const VectorXd& u, Eigen::Index t) {
  Matrix4Xd rates = Matrix4Xd::Zero(4, t + 1);
  for (Eigen::Index k = 1; k <= t; ++k) rates.col(k) = (y.col(k) - y.col(k - 1)) / kTau;
  const auto average = [&](const Matrix4Xd& of, double factor) {
    Vector4d sum = std::pow(factor, t) * of.col(0);
    for (Eigen::Index k = 1; k <= t; ++k) sum += (1 - factor) * std::pow(factor, t - k) * of.col(k);
    return sum;
  };
  VectorXd features(27);
  features << 1, y.col(t), rates.col(t), average(y, 0.5), average(rates, 0.5), average(y, 0.9),
      average(rates, 0.9), t > 0 ? u[t - 1] : 0, t > 1 ? u[t - 2] : 0;
  return features;
}

TEST(RacerPolicy, TakesTheFeaturesOfItsDocument) {
  Rng rng(1);
  const VectorXd w = 0.01 * rng.normalVector(27);
  RacerPolicy policy(kAll, w, kTau, 1e9);
  constexpr Eigen::Index kSteps = 40;
  for (int round = 0; round < 2; ++round) {
    Matrix4Xd y(4, kSteps);
    VectorXd u(kSteps);
    for (Eigen::Index t = 0; t < kSteps; ++t) {
      y.col(t) = rng.normalVector(4);
      u[t] = policy.control(y.col(t));
      EXPECT_NEAR(u[t], w.dot(featuresOf(y, u, t)), 1e-11) << round << " " << t;
    }
    policy.reset();
  }
}

// Where each group of features stands among all.
TEST(RacerPolicy, TakesGroupsOfThemInOrder) {
  const std::vector<int> sensors{0, 1, 2, 3, 4}, rates{5, 6, 7, 8}, averages{9, 10, 11, 12, 17, 18, 19, 20},
      averagedRates{13, 14, 15, 16, 21, 22, 23, 24}, controls{25, 26};
  Rng rng(2);
  for (int chosen = 0; chosen < 16; ++chosen) {
    const RacerFeatures features{(chosen & 1) != 0, (chosen & 2) != 0, (chosen & 4) != 0, (chosen & 8) != 0};
    std::vector<int> places = sensors;
    const auto add = [&](bool isThere, const std::vector<int>& more) {
      if (isThere) places.insert(places.end(), more.begin(), more.end());
    };
    add(features.rates, rates);
    add(features.averages, averages);
    add(features.averagedRates, averagedRates);
    add(features.controls, controls);
    std::sort(places.begin(), places.end());
    ASSERT_EQ(features.count(), static_cast<int>(places.size()));

    const VectorXd w = 0.01 * rng.normalVector(features.count());
    VectorXd among = VectorXd::Zero(27);
    for (int i = 0; i < w.size(); ++i) among[places[static_cast<std::size_t>(i)]] = w[i];
    RacerPolicy few(features, w), all(kAll, among);
    for (int t = 0; t < 5; ++t) {
      const Vector4d y = rng.normalVector(4);
      EXPECT_EQ(few.control(y), all.control(y));
    }
  }
}

TEST(RacerPolicy, KeepsTheLimit) {
  VectorXd w = VectorXd::Zero(5);
  w[4] = 100;
  RacerPolicy policy({}, w, kTau, 3);
  EXPECT_EQ(policy.control(Vector4d(0, 0, 0, 1)), 3);
  EXPECT_EQ(policy.control(Vector4d(0, 0, 0, -1)), -3);
  EXPECT_EQ(policy.control(Vector4d(0, 0, 0, 0.01)), 1);
}

TEST(RacerPolicy, RefusesWhatHasNoMeaning) {
  const VectorXd w = VectorXd::Zero(5);
  EXPECT_REX_ERROR(RacerPolicy(kAll, w),
                   "racer: weights of features: found a vector of size 5, wanted size 27");
  EXPECT_REX_ERROR(RacerPolicy({}, VectorXd::Constant(5, kNan)),
                   "racer: weights of features: number 0: found nan");
  EXPECT_REX_ERROR(RacerPolicy({}, w, 0), "racer: time step tau: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(RacerPolicy({}, w, 1, -2),
                   "racer: limit of u: found -2, wanted a positive, finite number");
  EXPECT_REX_ERROR(RacerPolicy({}, w).control(Vector4d(0, 0, kNan, 0)),
                   "racer: measured y: number 2: found nan");
}

}  // namespace rex::racer_policy_test
