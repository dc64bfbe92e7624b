#include "control/racer_rollouts.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "base/cpu_lanes.h"
#include "control/racer_rollouts_internal.h"
#include "support/allocations.h"
#include "support/expect_error.h"

namespace rex::racer_rollouts_test {

using Eigen::MatrixXd;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct One {
  double cost = 0;
  int steps = 0;
};

// The loop that the batch stands for.
One rolledOut(const VectorXd& w, const Trial& trial, const RacerRolloutOptions& o) {
  RacerPolicy policy(o.features, w, o.tau, o.largestControl);
  Rng rng(trial.seed);
  Vector4d x = trial.start;
  One one;
  for (; one.steps < o.steps; ++one.steps) {
    const double u = policy.control(o.sensors.measured(x, o.dynamics.r));
    x = o.dynamics.noisyStep(x, u, o.tau, o.noise, rng);
    if (std::abs(x[1]) > o.largestAngle) break;
    const Vector4d y = o.sensors.measured(x, o.dynamics.r);
    one.cost += o.cost.x * (x[0] * x[0]) + o.cost.theta * (x[1] * x[1]) + o.cost.gyro * (y[2] * y[2]) +
                o.cost.wheel * (y[3] * y[3]);
  }
  one.cost += o.cost.failure * (o.steps - one.steps);
  return one;
}

std::vector<Trial> trials(int count, double size) {
  Rng rng(7);
  std::vector<Trial> result;
  for (int k = 0; k < count; ++k) result.push_back({size * rng.normalVector(4), rng.next()});
  return result;
}

bool haveSameBits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Batched by so many lanes, against one after the other. Some policies hold the racer for long, most do not.
class RacerRolloutsOfLanes : public testing::TestWithParam<int> {};

TEST_P(RacerRolloutsOfLanes, HaveTheBitsOfOne) {
  if (GetParam() > cpuLanes()) GTEST_SKIP() << "this CPU has no AVX2";
  const auto kernel = kernelFor<internal::RacerRolloutsKernel>(GetParam());
  Rng rng(8);
  for (const bool full : {false, true}) {
    RacerRolloutOptions options{.features = {full, full, full, full},
                                .cost = {.x = 1.5, .theta = 10, .gyro = 0.1, .wheel = 0.2, .failure = 7},
                                .steps = 200};
    MatrixXd W = 0.02 * MatrixXd::Zero(options.features.count(), 5);
    for (int k = 0; k < 5; ++k) {
      W.col(k) = 0.005 * rng.normalVector(options.features.count());
      W(2, k) += 4;
      W(3, k) += 0.6;
      W(0, k) -= 4 * 1.021875 * std::sin(0.16) - 0.6 * 0.0417273;
    }
    for (const int count : {1, 3, 8}) {
      const auto all = trials(count, 0.1);
      const Rollouts batch = internal::racerRollouts(kernel, W, all, options);
      ASSERT_EQ(batch.cost.rows(), count);
      ASSERT_EQ(batch.cost.cols(), W.cols());
      for (int policy = 0; policy < W.cols(); ++policy) {
        for (int k = 0; k < count; ++k) {
          const One one = rolledOut(W.col(policy), all[static_cast<std::size_t>(k)], options);
          EXPECT_EQ(batch.steps(k, policy), one.steps) << k << " " << policy;
          EXPECT_TRUE(haveSameBits(batch.cost(k, policy), one.cost)) << k << " " << policy;
        }
      }
      EXPECT_GT(batch.steps.maxCoeff(), 20);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(OneTwoAndFour, RacerRolloutsOfLanes, testing::Values(1, 2, 4));

TEST(RacerRollouts, CutTheReturnWhereTheRacerFails) {
  const MatrixXd none = MatrixXd::Zero(5, 1);
  const Trial trial{.start = Vector4d(0, 0.5, 0, 0)};
  RacerRolloutOptions options{.cost = {.x = 0, .theta = 0, .failure = 2}, .steps = 100, .noise = 0};
  const Rollouts fallen = racerRollouts(none, {trial}, options);
  // By the equation alone: how long the angle stays below.
  Vector4d x = trial.start;
  int steps = -1;
  for (; std::abs(x[1]) <= options.largestAngle; ++steps) x = RacerDynamics{}.rungeKuttaStep(x, 0, 0.01);
  EXPECT_EQ(fallen.steps(0, 0), steps);
  EXPECT_EQ(fallen.cost(0, 0), 2 * (100 - steps));
  options.largestAngle = 100;
  EXPECT_EQ(racerRollouts(none, {trial}, options).steps(0, 0), 100);
  EXPECT_EQ(racerRollouts(none, {trial}, options).cost(0, 0), 0);
}

// Weights beyond all measure make infinite or undefined sums, of which a limit is left.
TEST(RacerRollouts, EndForAnyFiniteWeights) {
  const MatrixXd W = MatrixXd::Constant(27, 1, 1e308).array() * Eigen::ArrayXd::LinSpaced(27, -1, 1);
  RacerRolloutOptions options{.features = {true, true, true, true}};
  const Rollouts wild = racerRollouts(W, trials(5, 0.1), options);
  EXPECT_TRUE(wild.cost.allFinite());
  EXPECT_LT(wild.steps.maxCoeff(), 500);
}

TEST(RacerRollouts, TakeNoneOfPoliciesTrialsOrSteps) {
  EXPECT_EQ(racerRollouts(MatrixXd::Zero(5, 0), trials(3, 0.1)).cost.size(), 0);
  EXPECT_EQ(racerRollouts(MatrixXd::Zero(5, 4), {}).cost.size(), 0);
  const Rollouts still = racerRollouts(MatrixXd::Zero(5, 4), trials(3, 0.1), {.steps = 0});
  EXPECT_TRUE(still.steps.isZero());
  EXPECT_TRUE(still.cost.isZero());
}

TEST(RacerRollouts, AllocateForTheirResultsOnly) {
  const auto allocated = [](int policies, int count) {
    const MatrixXd W = MatrixXd::Zero(5, policies);
    const auto all = trials(count, 0.1);
    const long before = allocations();
    const Rollouts result = racerRollouts(W, all, {.steps = policies});
    return allocations() - before;
  };
  const long few = allocated(2, 3);
#ifndef __SANITIZE_ADDRESS__  // where allocations are not counted
  EXPECT_GE(few, 2);
#endif
  EXPECT_EQ(allocated(40, 20), few);
}

TEST(RacerRollouts, RefuseWhatHasNoMeaning) {
  const MatrixXd W = MatrixXd::Zero(5, 1);
  const auto all = trials(2, 0.1);
  EXPECT_REX_ERROR(racerRollouts(MatrixXd::Zero(6, 1), all),
                   "racer: weights of features, a column: found a vector of size 6, wanted size 5");
  EXPECT_REX_ERROR(racerRollouts(MatrixXd::Constant(5, 1, kNan), all),
                   "racer: weights of features: number 0: found nan");
  EXPECT_REX_ERROR(racerRollouts(W, {{}, {.start = Vector4d(0, kNan, 0, 0)}}),
                   "racer: start of trial 1: number 1: found nan");
  const auto refuses = [&](const RacerRolloutOptions& options, const char* text) {
    EXPECT_REX_ERROR(racerRollouts(W, all, options), text);
  };
  refuses({.steps = -1}, "racer: steps: found -1, wanted 0 or more");
  refuses({.tau = 0}, "racer: time step tau: found 0");
  refuses({.noise = -1}, "racer: noise: found -1");
  refuses({.largestControl = 0}, "racer: limit of u: found 0");
  refuses({.largestAngle = 0}, "racer: largest angle: found 0");
  refuses({.cost = {.gyro = kNan}}, "racer: weights of the cost: number 2: found nan");
  refuses({.dynamics = {.r = -1}}, "racer: radius r: found -1");
  refuses({.sensors = {.phi = kNan}}, "racer: sensor constant phi: found nan");
}

}  // namespace rex::racer_rollouts_test
