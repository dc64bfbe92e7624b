#include "course/cart_pole.h"

#include <limits>

#include <gtest/gtest.h>

#include "control/cart_pole_rollouts.h"
#include "control/riccati.h"
#include "support/expect_error.h"

namespace rex::cart_pole_test {

using Eigen::Vector4d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(CartPole, StepsAsItsDynamics) {
  CartPole still(0, {.noise = 0});
  EXPECT_EQ(still.x, Vector4d(0, 0, 0.2, 0));
  EXPECT_DOUBLE_EQ(still.options().tau, 1. / 60);
  still.x = Vector4d(0.1, -0.3, 0.4, 0.7);
  const double energy = CartPoleDynamics{}.energy(still.x);
  EXPECT_EQ(still.getEnergy(), energy);
  const Vector4d next = CartPoleDynamics{}.eulerStep(still.x, 2.5, 1. / 60);
  still.step(2.5);
  EXPECT_EQ(still.x, next);
}

// Exercise 12.11 d), and the same steps as a rollout with that seed.
TEST(CartPole, IsHeldByItsRegulator) {
  const LinearizedPlant plant = CartPole().getLinearization();
  const Eigen::Matrix4d Q = Vector4d(1, 0, 1, 0).asDiagonal();
  const Vector4d gains = -solveCare(plant.A, plant.B, Q, Eigen::MatrixXd::Identity(1, 1)).K.transpose();
  for (const std::uint64_t seed : {1, 2}) {
    CartPole cart(seed);
    double cost = 0;
    for (int t = 0; t < 600; ++t) {
      const double u = gains.dot(cart.x);
      cost += (cart.x[0] * cart.x[0] + cart.x[2] * cart.x[2] + u * u) / 60;
      cart.step(u);
      ASSERT_LT(std::abs(cart.x[2]), 1);
    }
    const Rollouts rollout = cartPoleRollouts(gains, {{Vector4d(0, 0, 0.2, 0), seed}}, {.steps = 600});
    EXPECT_NEAR(rollout.cost(0, 0), cost, 1e-9 * cost);
  }
}

TEST(CartPole, RefusesWhatHasNoMeaning) {
  EXPECT_REX_ERROR(CartPole(0, {.tau = 0}),
                   "cart pole: time step tau: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(CartPole(0, {.noise = -1}), "cart pole: noise: found -1");
  EXPECT_REX_ERROR(CartPole(0, {.dynamics = {.l = -1}}), "cart pole: length l: found -1");
  CartPole cart;
  EXPECT_REX_ERROR(cart.step(kNan), "cart pole: control u: found nan");
  cart.x[1] = kNan;
  EXPECT_REX_ERROR(cart.step(0), "cart pole: state: number 1: found nan");
  EXPECT_REX_ERROR(cart.getEnergy(), "cart pole: state: number 1: found nan");
}

}  // namespace rex::cart_pole_test
