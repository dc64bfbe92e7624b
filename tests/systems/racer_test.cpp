#include "systems/racer.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/derivative_check.h"
#include "control/racer_rollouts.h"
#include "control/riccati.h"
#include "dynamics/equations_of_motion.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/runge_kutta.h"

namespace rex::racer_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
const RacerDynamics kOdd{.r = 0.1, .l = 0.3, .mA = 0.2, .mB = 0.9, .IA = 0.001, .IB = 0.02, .g = 9.81};

VectorXd vectorOf(const nlohmann::json& json) {
  const auto numbers = json.get<std::vector<double>>();
  return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}
Vector4d stateOf(const Vector2d& q, const Vector2d& v) { return (Vector4d() << q, v).finished(); }

TEST(RacerDynamics, AgreesWithTheGoldenNumbers) {
  const RacerDynamics plant;
  std::ifstream stream(sourcePath("tests/golden/exercises.json"));
  const nlohmann::json golden = nlohmann::json::parse(stream)["racer"];
  EXPECT_EQ(plant.controlDirection(), vectorOf(golden["B"]));
  ASSERT_FALSE(golden["cases"].empty());
  for (const nlohmann::json& one : golden["cases"]) {
    const Vector2d q = vectorOf(one["q"]), v = vectorOf(one["qdot"]);
    for (int row = 0; row < 2; ++row)
      EXPECT_LT((plant.massMatrix(q).row(row).transpose() - vectorOf(one["M"][static_cast<std::size_t>(row)]))
                    .norm(),
                1e-15);
    EXPECT_LT((plant.forces(q, v) - vectorOf(one["F_correct"])).norm(), 1e-14);
    const Vector4d next = plant.rungeKuttaStep(stateOf(q, v), one["u"], golden["tau"]);
    EXPECT_LT((next.head<2>() - vectorOf(one["q_next_rk4"])).norm(), 1e-14);
    EXPECT_LT((next.tail<2>() - vectorOf(one["qdot_next_rk4"])).norm(), 1e-13);
  }
}

// Slide 3:23: the energies come from the velocities of the bodies' poses, here by differences of them.
TEST(RacerDynamics, FollowsFromTheLagrangianOfItsPoses) {
  const auto lagrangian = [](const VectorXd& q, const VectorXd& v) {
    const auto flat = [](const VectorXd& at) { return VectorXd(kOdd.poses(at).reshaped()); };
    const VectorXd rates = numericJacobian(flat, q) * v;
    Eigen::Matrix<double, 6, 1> masses;
    masses << kOdd.mA, kOdd.mA, kOdd.IA, kOdd.mB, kOdd.mB, kOdd.IB;
    const Eigen::Matrix<double, 3, 2> at = kOdd.poses(q);
    return rates.dot(masses.asDiagonal() * rates) / 2 - kOdd.g * (kOdd.mA * at(1, 0) + kOdd.mB * at(1, 1));
  };
  Rng rng(1);
  for (const double size : {0., 1e-8, 1., 3.}) {
    const Vector2d q = size * rng.normalVector(2), v = size * rng.normalVector(2);
    const EquationOfMotion numeric = equationOfMotion(lagrangian, q, v);
    EXPECT_LT((numeric.M - kOdd.massMatrix(q)).norm(), 1e-7) << size;
    EXPECT_LT((numeric.F - kOdd.forces(q, v)).norm(), 1e-7 * (1 + v.squaredNorm())) << size;
    const double potential = kOdd.energy(stateOf(q, Vector2d::Zero()));
    EXPECT_NEAR(lagrangian(q, v) + 2 * potential, kOdd.energy(stateOf(q, v)), 1e-8 * (1 + v.squaredNorm()));
  }
}

TEST(RacerDynamics, DerivativeSolvesTheEquationOfMotion) {
  Rng rng(2);
  for (const double size : {0., 1e-8, 1., 30.}) {
    const Vector4d x = size * rng.normalVector(4);
    const Vector2d q = x.head<2>(), v = x.tail<2>();
    const double u = size * rng.normal();
    const Vector4d rate = kOdd.derivative(x, u);
    EXPECT_EQ(rate.head<2>(), v);
    const Vector2d left = kOdd.massMatrix(q) * rate.tail<2>() + kOdd.forces(q, v),
                   right = kOdd.controlDirection() * u;
    EXPECT_LT((left - right).norm(), 1e-12 * (1 + left.norm() + kOdd.forces(q, v).norm())) << size;
  }
}

// Upright, a light wheel and a slender body leave little of the determinant of M: here 1e-12 of its products.
// By hand: with wheel = mA + IA / r^2, det M = wheel (mB l^2 + IB) + mB IB.
TEST(RacerDynamics, KeepsTheDeterminantOfLightWheels) {
  const RacerDynamics light{.r = 1, .l = 1, .mA = 1e-12, .mB = 1, .IA = 1e-12, .IB = 1e-20, .g = 9.8};
  const Vector4d rate = light.derivative(Vector4d::Zero(), 1e-12);
  EXPECT_NEAR(rate[2] / ((1 + 1e-20 + 1) * 1e-12 / 2e-12), 1, 1e-6);
  EXPECT_NEAR(rate[3] / (-(1 + 2e-12 + 1) * 1e-12 / 2e-12), 1, 1e-6);
  const LinearizedPlant linear = light.linearized(Vector4d::Zero(), 0);
  EXPECT_NEAR(linear.B[2] / (2 / 2e-12), 1, 1e-6);
  EXPECT_NEAR(linear.A(3, 1) / (9.8 * (1 + 2e-12) / 2e-12), 1, 1e-6);
}

TEST(RacerDynamics, StepIsTheClassicOne) {
  Rng rng(3);
  for (const double tau : {0.01, 0.1}) {
    const Vector4d x = rng.normalVector(4);
    const double u = rng.normal();
    const auto rate = [&](const Vector4d& at) { return kOdd.derivative(at, u); };
    EXPECT_LT((kOdd.rungeKuttaStep(x, u, tau) - rungeKutta4Step(rate, x, tau)).norm(), 1e-12);
  }
}

// While it falls over and swings through, at up to 23 rad/s.
TEST(RacerDynamics, FreeMotionKeepsItsEnergy) {
  const RacerDynamics plant;
  const Vector4d start(0.1, 0.3, 0.5, -0.4);
  const auto lost = [&](double tau) {
    Vector4d x = start;
    double worst = 0;
    for (int i = 0; i < std::lround(2 / tau); ++i) {
      x = plant.rungeKuttaStep(x, 0, tau);
      worst = std::max(worst, std::abs(plant.energy(x) - plant.energy(start)));
    }
    return worst;
  };
  EXPECT_LT(lost(0.0005), 1e-7);
  EXPECT_NEAR(lost(0.001) / lost(0.0005), 16, 1);  // fourth order
}

TEST(RacerDynamics, LinearizationIsItsDerivative) {
  Rng rng(4);
  for (const double size : {0., 1e-8, 1.}) {
    const VectorXd z = size * rng.normalVector(5);
    const auto rate = [](const VectorXd& at) { return VectorXd(kOdd.derivative(at.head<4>(), at[4])); };
    const LinearizedPlant linear = kOdd.linearized(z.head<4>(), z[4]);
    const JacobianCheck check =
        checkJacobian(rate, (Eigen::Matrix<double, 4, 5>() << linear.A, linear.B).finished(), z, 1e-8);
    EXPECT_TRUE(check.ok) << size << check.message;
  }
  const LinearizedPlant upright = RacerDynamics{}.linearized(Vector4d::Zero(), 0);
  EXPECT_NEAR(upright.A(3, 1), 129.706, 5e-4);
  EXPECT_NEAR(upright.B[3], -523.53, 5e-3);
  EXPECT_NEAR(upright.A(2, 1), -57.647, 5e-4);
  EXPECT_NEAR(upright.B[2], 268.24, 5e-3);
}

TEST(RacerDynamics, GainsAreThoseOfItsDocument) {
  const LinearizedPlant upright = RacerDynamics{}.linearized(Vector4d::Zero(), 0);
  const Eigen::Matrix4d Q = Vector4d(1, 10, 0, 0).asDiagonal();
  const RiccatiResult lqr = solveCare(upright.A, upright.B, Q, Eigen::MatrixXd::Identity(1, 1));
  EXPECT_LT((lqr.K.transpose() - Vector4d(-1, -4.268, -0.9554, -0.6093)).norm(), 1e-3);
}

TEST(RacerDynamics, NoiseGrowsWithTheRootOfTheStep) {
  const RacerDynamics plant;
  const Vector4d x(0.2, 0.1, -0.3, 1);
  constexpr int kDraws = 20000;
  for (const double tau : {0.01, 0.04}) {
    Rng rng(5);
    Eigen::Matrix4d squares = Eigen::Matrix4d::Zero();
    for (int i = 0; i < kDraws; ++i) {
      const Vector4d d = plant.noisyStep(x, 1, tau, 0.3, rng) - plant.rungeKuttaStep(x, 1, tau);
      squares += d * d.transpose();
    }
    const double variance = tau * 0.3 * 0.3;
    const Eigen::Matrix4d wanted = variance * Vector4d(0, 0, 1, 1).asDiagonal().toDenseMatrix();
    EXPECT_LT((squares / kDraws - wanted).norm(), 6 * variance / std::sqrt(kDraws));
  }
}

TEST(RacerDynamics, RefusesWhatHasNoMeaning) {
  const RacerDynamics plant;
  const Vector2d q = Vector2d::Zero(), bad(0, kNan);
  const Vector4d x = Vector4d::Zero(), badState(0, 0, 0, kNan);
  Rng rng(6);
  EXPECT_REX_ERROR(plant.massMatrix(bad), "racer: q: number 1: found nan, wanted a finite number");
  EXPECT_REX_ERROR(plant.forces(bad, q), "racer: q: number 1");
  EXPECT_REX_ERROR(plant.forces(q, bad), "racer: velocities: number 1: found nan");
  EXPECT_REX_ERROR(plant.poses(bad), "racer: q: number 1");
  EXPECT_REX_ERROR(plant.energy(badState), "racer: state: number 3: found nan");
  EXPECT_REX_ERROR(plant.energy(Vector4d(kNan, 0, 0, 0)), "racer: state: number 0: found nan");
  EXPECT_REX_ERROR(plant.derivative(badState, 0), "racer: state: number 3: found nan");
  EXPECT_REX_ERROR(plant.linearized(x, kNan), "racer: control u: found nan");
  EXPECT_REX_ERROR(plant.rungeKuttaStep(x, 0, -1),
                   "racer: time step tau: found -1, wanted a positive, finite number");
  EXPECT_REX_ERROR(plant.noisyStep(x, 0, 0.1, -1, rng), "racer: noise: found -1");
  EXPECT_REX_ERROR((RacerDynamics{.r = 0}.controlDirection()), "racer: radius r: found 0");
  EXPECT_REX_ERROR((RacerDynamics{.l = -1}.derivative(x, 0)), "racer: length l: found -1");
  EXPECT_REX_ERROR((RacerDynamics{.mA = 0}.massMatrix(q)), "racer: mass mA: found 0");
  EXPECT_REX_ERROR((RacerDynamics{.mB = kNan}.massMatrix(q)), "racer: mass mB: found nan");
  EXPECT_REX_ERROR((RacerDynamics{.IA = 0}.forces(q, q)), "racer: inertia IA: found 0");
  EXPECT_REX_ERROR((RacerDynamics{.IB = 0}.poses(q)), "racer: inertia IB: found 0");
  EXPECT_REX_ERROR((RacerDynamics{.g = 0}.energy(x)), "racer: gravity g: found 0");
}

TEST(Racer, TellsWhatItIs) {
  Racer racer(0, {.noise = 0});
  EXPECT_EQ(racer.getState(), Vector4d(0, 0.01, 0, 0));
  racer.setState(Vector4d(0.3, 0.7, -1.1, 2.3));
  EXPECT_EQ(racer.q, Vector2d(0.3, 0.7));
  EXPECT_EQ(racer.v, Vector2d(-1.1, 2.3));
  MatrixXd M;
  VectorXd F, B;
  racer.getDynamics(M, F, B);
  // The equation of motion tells the energy's change: the power of u.
  const double u = 0.4;
  const Vector2d a = RacerDynamics{}.derivative(racer.getState(), u).tail<2>();
  EXPECT_LT((M * a + F - B * u).norm(), 1e-12);
  const double before = racer.getEnergy(), h = 1e-6;
  const double after = RacerDynamics{}.energy(RacerDynamics{}.rungeKuttaStep(racer.getState(), u, h));
  EXPECT_NEAR((after - before) / h, racer.v.dot(B) * u, 1e-3);

  EXPECT_EQ(racer.getObservation(), RacerSensors{}.measured(racer.getState(), 0.05));
  EXPECT_EQ(racer.getObservationJacobian(), RacerSensors{}.jacobian(racer.getState(), 0.05));
  const Vector4d next = RacerDynamics{}.rungeKuttaStep(racer.getState(), u, 0.01);
  racer.stepDynamics(u);
  EXPECT_EQ(racer.getState(), next);
}

TEST(Racer, IsHeldByItsRegulator) {
  Racer racer(3);
  const LinearizedPlant plant = racer.getLinearization();
  const Eigen::Matrix4d Q = Vector4d(1, 10, 0, 0).asDiagonal();
  const MatrixXd K = solveCare(plant.A, plant.B, Q, MatrixXd::Identity(1, 1)).K;
  for (int t = 0; t < 3000; ++t) {
    racer.stepDynamics(-(K * racer.getState())[0]);
    ASSERT_LT(std::abs(racer.q[1]), 0.2);
    ASSERT_LT(std::abs(racer.q[0]), 1);
  }
}

TEST(Racer, HasTheNoiseOfATrial) {
  VectorXd w(5);
  w << -0.6, 0, 4, 0.6, 0.02;
  const RacerFeatures features{};
  Racer racer(77);
  RacerPolicy policy(features, w);
  double cost = 0;
  for (int t = 0; t < 100; ++t) {
    racer.stepDynamics(policy.control(racer.getObservation()));
    cost += racer.q[0] * racer.q[0] + 10 * (racer.q[1] * racer.q[1]);
  }
  const Rollouts rollout = racerRollouts(w, {{Vector4d(0, 0.01, 0, 0), 77}}, {.steps = 100});
  EXPECT_EQ(rollout.steps(0, 0), 100);
  EXPECT_DOUBLE_EQ(rollout.cost(0, 0), cost);
}

TEST(Racer, RefusesWhatHasNoMeaning) {
  EXPECT_REX_ERROR(Racer(0, {.tau = 0}), "racer: time step tau: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(Racer(0, {.noise = -1}), "racer: noise: found -1");
  EXPECT_REX_ERROR(Racer(0, {.dynamics = {.r = 0}}), "racer: radius r: found 0");
  EXPECT_REX_ERROR(Racer(0, {.sensors = {.s = kNan}}), "racer: sensor constant s: found nan");
  Racer racer;
  EXPECT_REX_ERROR(racer.stepDynamics(kNan), "racer: control u: found nan");
  EXPECT_REX_ERROR(racer.setState(Vector4d(0, 0, kNan, 0)), "racer: state: number 2: found nan");
  racer.q[0] = kNan;
  EXPECT_REX_ERROR(racer.stepDynamics(0), "racer: state: number 0: found nan");
  EXPECT_REX_ERROR(racer.getObservation(), "racer: state: number 0: found nan");
}

}  // namespace rex::racer_test
