#include "course/racer.h"

#include <limits>

#include <gtest/gtest.h>

#include "control/racer_rollouts.h"
#include "control/riccati.h"
#include "support/expect_error.h"

namespace rex::racer_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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
