#include "systems/cart_pole.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/derivative_check.h"
#include "control/riccati.h"
#include "dynamics/equations_of_motion.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::cart_pole_test {

using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const CartPoleDynamics kOdd{.poleMass = 0.7, .cartMass = 1.9, .l = 0.6, .g = 9.81};

nlohmann::json goldenCartPole() {
  std::ifstream stream(sourcePath("tests/golden/exercises.json"));
  return nlohmann::json::parse(stream)["cartpole"];
}
VectorXd vectorOf(const nlohmann::json& json) {
  const auto numbers = json.get<std::vector<double>>();
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

TEST(CartPoleDynamics, AgreesWithTheGoldenNumbers) {
  const CartPoleDynamics plant;
  const nlohmann::json golden = goldenCartPole();
  ASSERT_FALSE(golden["steps"].empty());
  for (const nlohmann::json& one : golden["steps"]) {
    const Vector4d x = vectorOf(one["x"]);
    const double u = one["u"];
    EXPECT_NEAR(plant.derivative(x, u)[1], one["pddot"], 1e-13);
    EXPECT_NEAR(plant.derivative(x, u)[3], one["thetaddot"], 1e-13);
    EXPECT_LT((plant.eulerStep(x, u, one["tau"]) - vectorOf(one["x_next_euler"])).norm(), 1e-14);
  }
}

// The script's equations are those of an even rod with its middle at l: from the velocities of the cart and
// of the rod's middle, and the rod's inertia m l^2 / 3 about it.
TEST(CartPoleDynamics, FollowsFromItsLagrangian) {
  const Lagrangian L = [](const VectorXd& q, const VectorXd& v) {
    const Vector2d middle(v[0] + kOdd.l * v[1] * std::cos(q[1]), -kOdd.l * v[1] * std::sin(q[1]));
    const double kinetic = kOdd.cartMass * v[0] * v[0] + kOdd.poleMass * middle.squaredNorm() +
                           kOdd.poleMass * kOdd.l * kOdd.l / 3 * v[1] * v[1];
    return kinetic / 2 - kOdd.poleMass * kOdd.g * kOdd.l * std::cos(q[1]);
  };
  Rng rng(1);
  for (const double size : {0., 1e-8, 1., 3.}) {
    const Vector4d x = size * rng.normalVector(4);
    const double u = size * rng.normal();
    const Vector2d q(x[0], x[2]), v(x[1], x[3]);
    const Vector4d rate = kOdd.derivative(x, u);
    const VectorXd force = eulerLagrangeForce(L, q, v, Vector2d(rate[1], rate[3]));
    EXPECT_LT((force - Vector2d(u, 0)).norm(), 1e-8 * (1 + v.squaredNorm())) << size;
    const double twiceKinetic = L(q, v) + kOdd.energy(x);  // T - U + T + U
    EXPECT_NEAR(twiceKinetic / 2 + kOdd.poleMass * kOdd.g * kOdd.l * std::cos(q[1]), kOdd.energy(x),
                1e-12 * (1 + v.squaredNorm()));
  }
}

TEST(CartPoleDynamics, FreeMotionKeepsItsEnergy) {
  const Vector4d start(0.1, 0.5, 0.4, -1);
  const auto lost = [&](double tau) {
    Vector4d x = start;
    for (int i = 0; i < std::lround(0.5 / tau); ++i) x = kOdd.eulerStep(x, 0, tau);
    return kOdd.energy(x) - kOdd.energy(start);
  };
  EXPECT_NEAR(lost(1e-4) / lost(1e-5), 10, 0.2);  // Euler's first order
  EXPECT_NEAR(lost(1e-5), 0, 1e-3);
}

TEST(CartPoleDynamics, LinearizationIsItsDerivative) {
  Rng rng(2);
  for (const double size : {0., 1e-8, 1.}) {
    VectorXd z = size * rng.normalVector(5);
    const auto rate = [](const VectorXd& at) { return VectorXd(kOdd.derivative(at.head<4>(), at[4])); };
    const LinearizedPlant linear = kOdd.linearized(z.head<4>(), z[4]);
    const JacobianCheck check =
        checkJacobian(rate, (Eigen::Matrix<double, 4, 5>() << linear.A, linear.B).finished(), z, 1e-8);
    EXPECT_TRUE(check.ok) << size << check.message;
  }
}

// Erratum 32.
TEST(CartPoleDynamics, GainsAreThoseOfTheErrata) {
  const LinearizedPlant linear = CartPoleDynamics{}.linearized(Vector4d::Zero(), 0);
  EXPECT_NEAR(linear.A(1, 2), -5.88, 1e-13);
  EXPECT_NEAR(linear.A(3, 2), 11.76, 1e-13);
  EXPECT_LT((linear.B - Vector4d(0, 0.8, 0, -0.6)).norm(), 1e-14);

  const Eigen::Matrix4d Q = Vector4d(1, 0, 1, 0).asDiagonal();
  const Eigen::MatrixXd R = Eigen::MatrixXd::Identity(1, 1);
  const nlohmann::json golden = goldenCartPole();
  const RiccatiResult right = solveCare(linear.A, linear.B, Q, R);
  EXPECT_LT((-right.K.transpose() - vectorOf(golden["K_correct"])).norm(), 1e-9);
  EXPECT_LT((-right.K.transpose() - Vector4d(1, 2.6088, 52.9484, 16.5952)).norm(), 1e-4);

  Eigen::Matrix4d printed = linear.A;
  printed(1, 2) = -11.76;
  const RiccatiResult published = solveCare(printed, linear.B, Q, R);
  EXPECT_LT((-published.K.transpose() - vectorOf(golden["K_from_printed_A"])).norm(), 1e-9);
  const Eigen::MatrixXd loop = linear.A - linear.B * published.K;
  const Eigen::VectorXcd poles = loop.eigenvalues();
  EXPECT_NEAR(poles.real().maxCoeff(), -0.329, 5e-4);
  EXPECT_NEAR(right.closedLoop.real().maxCoeff(), -0.506, 5e-4);
}

TEST(CartPoleDynamics, NoiseChangesBothVelocitiesWhateverTheStep) {
  const CartPoleDynamics plant;
  const Vector4d x(1, 2, 0.3, -1);
  constexpr int kDraws = 20000;
  constexpr double kNoise = 0.3;
  for (const double tau : {0.01, 0.5}) {
    Rng rng(3);
    Vector4d sum = Vector4d::Zero();
    Eigen::Matrix4d squares = Eigen::Matrix4d::Zero();
    for (int i = 0; i < kDraws; ++i) {
      const Vector4d d = plant.noisyStep(x, 1, tau, kNoise, rng) - plant.eulerStep(x, 1, tau);
      sum += d;
      squares += d * d.transpose();
    }
    const Eigen::Matrix4d wanted = kNoise * kNoise * Vector4d(0, 1, 0, 1).asDiagonal().toDenseMatrix();
    EXPECT_LT((sum / kDraws).norm(), 4 * kNoise / std::sqrt(kDraws));
    EXPECT_LT((squares / kDraws - wanted).norm(), 6 * kNoise * kNoise / std::sqrt(kDraws));
  }
}

TEST(CartPoleDynamics, RefusesWhatHasNoMeaning) {
  const CartPoleDynamics plant;
  const Vector4d x = Vector4d::Zero();
  Rng rng(4);
  EXPECT_REX_ERROR(plant.derivative(Vector4d(0, kNan, 0, 0), 0),
                   "cart pole: state: number 1: found nan, wanted a finite number");
  EXPECT_REX_ERROR(plant.derivative(x, kNan), "cart pole: control u: found nan");
  EXPECT_REX_ERROR(plant.linearized(x, kNan), "cart pole: control u: found nan");
  EXPECT_REX_ERROR(plant.energy(Vector4d(0, 0, 0, kNan)), "cart pole: state: number 3");
  EXPECT_REX_ERROR(plant.eulerStep(x, 0, 0),
                   "cart pole: time step tau: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(plant.noisyStep(x, 0, 0.1, -1, rng),
                   "cart pole: noise: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR((CartPoleDynamics{.poleMass = 0}.energy(x)), "cart pole: mass of the pole: found 0");
  EXPECT_REX_ERROR((CartPoleDynamics{.cartMass = -1}.energy(x)), "cart pole: mass of the cart: found -1");
  EXPECT_REX_ERROR((CartPoleDynamics{.l = kNan}.energy(x)), "cart pole: length l: found nan");
  EXPECT_REX_ERROR((CartPoleDynamics{.g = 0}.derivative(x, 0)), "cart pole: gravity g: found 0");
}

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

// Exercise 12.11 d).
TEST(CartPole, IsHeldByItsRegulator) {
  const LinearizedPlant plant = CartPole().getLinearization();
  const Eigen::Matrix4d Q = Vector4d(1, 0, 1, 0).asDiagonal();
  const Vector4d gains = -solveCare(plant.A, plant.B, Q, Eigen::MatrixXd::Identity(1, 1)).K.transpose();
  for (const std::uint64_t seed : {1, 2}) {
    CartPole cart(seed);
    for (int t = 0; t < 600; ++t) {
      cart.step(gains.dot(cart.x));
      ASSERT_LT(std::abs(cart.x[2]), 1);
    }
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
