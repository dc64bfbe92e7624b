#include "control/cart_pole_rollouts.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "control/riccati.h"
#include "support/expect_error.h"

namespace rex::cart_pole_rollouts_test {

using Eigen::MatrixXd;
using Eigen::Vector4d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const Vector4d kOptimal(1, 2.6088, 52.9484, 16.5952), kPublished(1, 3.8271, 48.3070, 17.6159);

std::vector<Trial> trials(int count, double angle) {
  std::vector<Trial> result;
  for (int k = 0; k < count; ++k) result.push_back({Vector4d(0, 0, angle, 0), static_cast<std::uint64_t>(k)});
  return result;
}

bool recovers(const Vector4d& gains, double angle) {
  return cartPoleRollouts(gains, trials(1, angle), {.noise = 0}).steps(0, 0) == 3000;
}

TEST(CartPoleRollouts, RecoverFromTheStartsOfTheirDocument) {
  for (int i = 0; i <= 21; ++i) {
    EXPECT_TRUE(recovers(kOptimal, 0.05 * i)) << 0.05 * i;
    EXPECT_EQ(recovers(kPublished, 0.05 * i), i <= 18) << 0.05 * i;
  }
  EXPECT_FALSE(recovers(kOptimal, 1.1));
}

TEST(CartPoleRollouts, SurviveTheNoiseOfTheirDocument) {
  const auto survivors = [](double noise) {
    return (cartPoleRollouts(kOptimal, trials(100, 0.2), {.noise = noise}).steps.array() == 3000).count();
  };
  EXPECT_EQ(survivors(0.01), 100);
  EXPECT_EQ(survivors(0.1), 100);
  EXPECT_LT(survivors(0.3), 5);
}

// Near rest and without noise, the cost is x' X x of the discrete Riccati equation.
TEST(CartPoleRollouts, CostIsThatOfTheRiccatiEquation) {
  const CartPoleRolloutOptions options{.noise = 0};
  const LinearizedPlant plant = options.dynamics.linearized(Vector4d::Zero(), 0);
  const MatrixXd A = MatrixXd::Identity(4, 4) + options.tau * plant.A, B = options.tau * plant.B;
  const RiccatiResult lqr =
      solveDare(A, B, options.tau * options.Q, MatrixXd::Constant(1, 1, options.tau * options.R));
  ASSERT_EQ(lqr.status, RiccatiStatus::kSolved);
  const Vector4d start(2e-4, -1e-4, 1e-4, 3e-4);
  const double cost = cartPoleRollouts(-lqr.K.transpose(), {{.start = start}}, options).cost(0, 0);
  EXPECT_NEAR(cost / start.dot(lqr.X * start), 1, 1e-5);
}

TEST(CartPoleRollouts, AreALoopOverSteps) {
  const CartPoleRolloutOptions options{.failure = 3, .steps = 400, .noise = 0.2};
  MatrixXd W(4, 2);
  W << kOptimal, -kOptimal;
  const auto all = trials(6, 0.4);
  const Rollouts batch = cartPoleRollouts(W, all, options);
  for (int policy = 0; policy < 2; ++policy) {
    for (int k = 0; k < 6; ++k) {
      Rng rng(all[static_cast<std::size_t>(k)].seed);
      Vector4d x(0, 0, 0.4, 0);
      double cost = 0;
      int steps = 0;
      for (; steps < 400; ++steps) {
        const double u = W.col(policy).dot(x), now = x[0] * x[0] + x[2] * x[2] + u * u;
        x = options.dynamics.noisyStep(x, u, options.tau, 0.2, rng);
        if (std::abs(x[2]) > options.largestAngle) break;
        cost += now / 60;
      }
      EXPECT_EQ(batch.steps(k, policy), steps);
      EXPECT_NEAR(batch.cost(k, policy), cost + 3 * (400 - steps), 1e-9 * (1 + cost));
    }
  }
  EXPECT_EQ(batch.steps.col(0).minCoeff(), 400);
  EXPECT_LT(batch.steps.col(1).maxCoeff(), 100);
}

// Forces beyond all measure end a rollout before it costs what is not a number.
TEST(CartPoleRollouts, EndForAnyFiniteGains) {
  const CartPoleRolloutOptions options{.R = 0, .steps = 10};
  for (const double size : {1e160, 1e200, 1e308}) {
    const std::vector<Trial> far{{Vector4d(0, 0, 0.2, 0), 1}, {Vector4d(1e3, 0, 0.2, 0), 2}};
    const Rollouts wild = cartPoleRollouts(size * kOptimal.normalized(), far, options);
    EXPECT_TRUE(wild.cost.allFinite()) << size << wild.cost.transpose();
    EXPECT_LE(wild.steps.maxCoeff(), 1) << size;
  }
}

TEST(CartPoleRollouts, RefuseWhatHasNoMeaning) {
  const auto refuses = [](const CartPoleRolloutOptions& options, const char* text) {
    EXPECT_REX_ERROR(cartPoleRollouts(kOptimal, trials(1, 0), options), text);
  };
  EXPECT_REX_ERROR(cartPoleRollouts(MatrixXd::Zero(3, 1), {}),
                   "cart pole: gains, a column: found a vector of size 3, wanted size 4");
  EXPECT_REX_ERROR(cartPoleRollouts(MatrixXd::Constant(4, 1, kNan), {}),
                   "cart pole: gains: number 0: found nan");
  EXPECT_REX_ERROR(cartPoleRollouts(kOptimal, trials(2, kNan)),
                   "cart pole: start of trial 0: number 2: found nan");
  refuses({.steps = -2}, "cart pole: steps: found -2, wanted 0 or more");
  refuses({.tau = 0}, "cart pole: time step tau: found 0");
  refuses({.noise = -1}, "cart pole: noise: found -1");
  refuses({.largestAngle = 0}, "cart pole: largest angle: found 0");
  refuses({.Q = Eigen::Matrix4d::Constant(kNan)}, "cart pole: costs Q: number 0: found nan");
  refuses({.R = kNan}, "cart pole: costs R: found nan");
  refuses({.failure = kNan}, "cart pole: cost of a failure: found nan");
  refuses({.dynamics = {.l = 0}}, "cart pole: length l: found 0");
}

}  // namespace rex::cart_pole_rollouts_test
