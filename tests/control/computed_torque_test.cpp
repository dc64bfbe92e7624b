#include "control/computed_torque.h"

#include <cmath>

#include <gtest/gtest.h>

#include "control/point_mass.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/ors_reader.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/random_scene.h"

namespace rex::computed_torque_test {

Model robot(const std::string& name) {
  return compile(readOrs(sourcePath("data/robots") / (name + ".ors")).spec);
}

TEST(ComputedTorque, IsSlide329) {
  Rng rng(1);
  const Model model = compile(randomScene(rng, 14));
  for (int i = 0; i < 20; ++i) {
    const State state{randomPositions(rng, model.nq()), rng.normalVector(model.nv())};
    const Reference reference{model.initialPositions(), rng.normalVector(model.nv()),
                              rng.normalVector(model.nv())};
    const PdGains gains = pdGains(1, 0.3, 0.8);
    const Eigen::VectorXd u = computedTorque(model, state, reference, gains);
    const auto [M, F] = equationOfMotion(model, state.q, state.v);
    const Eigen::VectorXd a = followReference(model, state, reference, gains);
    EXPECT_LT((u - (M * a + F)).norm(), 1e-9 * (1 + u.norm()));
    EXPECT_LT((forwardDynamics(model, state.q, state.v, u) - a).norm(), 1e-7 * (1 + a.norm()));
  }
}

// Slide 3:30: each joint behaves like a point mass. What is left comes from holding u for a step, and halves
// with it.
TEST(ComputedTorque, MakesJointsBehaveLikePointMasses) {
  for (const char* name : {"pegArm", "arm7"}) {
    const Model model = robot(name);
    const PdGains gains = pdGains(1, 0.2, 0.7);
    const Eigen::VectorXd e = Eigen::VectorXd::LinSpaced(model.nv(), 0.3, -0.4);
    const Reference target = standAt(model, model.initialPositions());
    double before = 0;
    for (const double h : {2e-3, 1e-3}) {
      State state{target.q + e, Eigen::VectorXd::Zero(model.nv())};
      Stepper stepper(model);
      double worst = 0;
      for (int i = 1; i <= std::lround(1 / h); ++i) {
        stepper.step(state, computedTorque(model, state, target, gains), h);
        for (int k = 0; k < model.nv(); ++k) {
          const double wanted = pdResponse({1}, gains, {e[k], 0}, 0, i * h).q;
          worst = std::max(worst, std::abs(state.q[k] - target.q[k] - wanted));
        }
      }
      EXPECT_LT(worst, 0.01) << name;
      if (before > 0) {
        EXPECT_NEAR(before / worst, 2, 0.2) << name;
      }
      before = worst;
    }
  }
}

// With its feedforward the arm follows to the hold's accuracy, without it falls behind by about lambda^2 a.
TEST(ComputedTorque, FollowsAMovingReference) {
  const Model model = robot("pegArm");
  const PdGains gains = pdGains(1, 0.1, 1);
  const Eigen::VectorXd q0 = model.initialPositions(), qT = q0 + Eigen::Vector3d(1, -0.8, 0.6);
  const auto worstDistance = [&](bool knowsAcceleration) {
    State state{q0, Eigen::VectorXd::Zero(3)};
    Stepper stepper(model);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      Reference reference =
          referenceAlong(model, q0, qT, 1, state.time, {.shape = ProfileShape::kMinimumJerk});
      worst = std::max(worst, (state.q - reference.q).cwiseAbs().maxCoeff());
      if (!knowsAcceleration) reference.a.setZero();
      stepper.step(state, computedTorque(model, state, reference, gains), 1e-3);
    }
    return worst;
  };
  EXPECT_LT(worstDistance(true), 1e-3);
  EXPECT_GT(worstDistance(false), 1e-2);
}

// A free body and a ball joint: gravity is carried, and the quaternion turns the short way.
TEST(ComputedTorque, HoldsQuaternionJoints) {
  Rng rng(2);
  const Model model = compile(randomScene(rng, 13));
  ASSERT_NE(model.nq(), model.nv());
  const Reference target = standAt(model, model.initialPositions());
  const Eigen::VectorXd e = 0.1 * rng.normalVector(model.nv());
  State state{integrate(model, target.q, e), Eigen::VectorXd::Zero(model.nv())};
  Stepper stepper(model);
  for (int i = 0; i < 1000; ++i)
    stepper.step(state, computedTorque(model, state, target, pdGains(1, 0.1, 1)), 1e-3);
  EXPECT_LT(difference(model, state.q, target.q).norm(), 2e-3 * e.norm());
}

TEST(ComputedTorque, RefusesWhatGivesNoForces) {
  const Model model = robot("pegArm");
  const Reference target = standAt(model, model.initialPositions());
  EXPECT_REX_ERROR(computedTorque(model, {target.q, Eigen::VectorXd::Zero(2)}, target, {}),
                   "joint velocities v: found a vector of size 2, wanted size 3");
  const State state = initialState(model);
  EXPECT_REX_ERROR(computedTorque(model, state, target, {.Kp = std::nan("")}), "gain Kp: found nan");
  EXPECT_REX_ERROR(computedTorque(model, state, target, {}, {0, 0, std::nan("")}),
                   "gravity: number 2: found nan");
}

}  // namespace rex::computed_torque_test
