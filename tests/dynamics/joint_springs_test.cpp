#include "dynamics/joint_springs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "geometry/rotation.h"
#include "support/expect_error.h"
#include "support/random_motion.h"

namespace rex::joint_springs_test {

using Eigen::VectorXd;

// With joints that follow others.
Model springy(Rng& rng, int bodies) {
  SceneSpec spec = randomScene(rng, bodies);
  addDetails(rng, spec);
  for (BodySpec& body : spec.bodies) body.shapes.clear();
  spec.worldShapes.clear();
  return compile(spec);
}

TEST(JointSprings, PullAgainstTheGradientOfTheirEnergy) {
  Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const Model model = springy(rng, 24 + i);
    ASSERT_TRUE(model.hasSprings());
    const VectorXd q = randomPositions(rng, model.nq());
    const auto energyAt = [&](const VectorXd& way) {
      return VectorXd::Constant(1, springEnergy(model, integrate(model, q, way)));
    };
    const JacobianCheck check =
        checkJacobian(energyAt, -springForces(model, q).transpose(), VectorXd::Zero(model.nv()));
    EXPECT_TRUE(check.ok) << check.message;
  }
}

TEST(JointSprings, AreInEnergyAndItsGradient) {
  Rng rng(2);
  const Model model = springy(rng, 30);
  const VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
  const auto total = [&](const VectorXd& way) {
    return VectorXd::Constant(1, energy(model, integrate(model, q, way), v).total());
  };
  const JacobianCheck check =
      checkJacobian(total, energyGradient(model, q, v).byPosition.transpose(), VectorXd::Zero(model.nv()));
  EXPECT_TRUE(check.ok) << check.message;
}

JointSpec onWorld(const char* body, JointType type) {
  return {.name = body, .parent = "world", .child = body, .type = type, .X_PF = {}, .X_MC = {}};
}

TEST(JointSprings, OfOneCoordinate) {
  SceneSpec spec;
  spec.bodies = {{.name = "a", .X_WB = {}, .mass = 1}, {.name = "b", .X_WB = {}, .mass = 1}};
  spec.joints = {onWorld("a", JointType::kSlider), onWorld("b", JointType::kSlider)};
  for (JointSpec& joint : spec.joints) joint.stiffness = 10;
  spec.joints[0].springReference = VectorXd::Constant(1, .2);
  const VectorXd q = VectorXd::Constant(2, .5);
  EXPECT_NEAR(springForces(compile(spec), q)[0], -3, 1e-12);
  EXPECT_NEAR(springForces(compile(spec), q)[1], -5, 1e-12);
  EXPECT_NEAR(springEnergy(compile(spec), q), 5 * (.09 + .25), 1e-12);
  // At 2 q + 1, and so twice as strong.
  spec.joints[1].mimic = "a";
  spec.joints[1].mimicRatio = 2;
  spec.joints[1].mimicOffset = 1;
  EXPECT_NEAR(springForces(compile(spec), q.head(1))[0], -3 - 2 * 20, 1e-12);
}

// A turn of 1.2 rad from its rest, about an axis of the body.
TEST(JointSprings, TurnBallsBack) {
  SceneSpec spec;
  spec.bodies = {{.name = "a", .X_WB = {}, .mass = 1}};
  spec.joints = {onWorld("a", JointType::kBall)};
  spec.joints[0].stiffness = 5;
  const Eigen::Vector3d turn = 1.2 * Eigen::Vector3d(1, -2, 2) / 3;
  const Quaternion rest = quaternionFromRotation(expSO3({.3, .2, .9}));
  spec.joints[0].springReference = 3 * rest;
  const Quaternion q = quaternionProduct(rest, quaternionFromRotation(expSO3(turn)));
  for (const double sign : {1., -1.})
    EXPECT_LT((springForces(compile(spec), sign * q) + 5 * turn).norm(), 1e-12);
  EXPECT_NEAR(springEnergy(compile(spec), q), 2.5 * 1.44, 1e-12);
}

TEST(JointSprings, ActInStepperUnlessSwitchedOff) {
  SceneSpec spec;
  spec.bodies = {{.name = "a", .X_WB = {}, .mass = 2}};
  spec.joints = {onWorld("a", JointType::kSlider)};
  spec.joints[0].stiffness = 50;
  const Model model = compile(spec);
  for (const bool isOn : {true, false}) {
    Stepper stepper(model, {.jointForces = {.springs = isOn}});
    State state{VectorXd::Constant(1, .1), VectorXd::Zero(1)};
    for (int i = 0; i < 100; ++i) stepper.step(state, VectorXd::Zero(1), 1e-2);
    EXPECT_NEAR(state.q[0], isOn ? .1 * std::cos(5.) : .1, 1e-7);
  }
}

TEST(JointSprings, KeepTheirEnergy) {
  Rng rng(3);
  for (const auto& [integrator, most] :
       {std::pair(Integrator::kRungeKutta4, 1e-6), std::pair(Integrator::kLeapfrog, 2e-3)}) {
    SceneSpec spec = randomScene(rng, 10);
    for (JointSpec& joint : spec.joints) joint.stiffness = rng.uniform(1, 20), joint.armature = rng.uniform();
    const Model model = compile(spec);
    Stepper stepper(model, {.integrator = integrator, .gravity_W = Eigen::Vector3d::Zero()});
    State state{randomPositions(rng, model.nq()), VectorXd::Zero(model.nv())};
    state.q = integrate(model, state.q, state.v);
    const double before = energy(model, state.q, state.v, Eigen::Vector3d::Zero()).total();
    double kinetic = 0, worst = 0;
    for (int i = 0; i < 1000; ++i) {
      stepper.step(state, VectorXd::Zero(model.nv()), 1e-3);
      const Energy now = energy(model, state.q, state.v, Eigen::Vector3d::Zero());
      kinetic = std::max(kinetic, now.kinetic);
      worst = std::max(worst, std::abs(now.total() - before));
    }
    EXPECT_LT(worst, most * before);
    EXPECT_GT(kinetic, .1 * before);
  }
}

TEST(JointSprings, NameWrongSizes) {
  Rng rng(4);
  const Model model = springy(rng, 24);
  VectorXd u(1);
  EXPECT_REX_ERROR(springForces(model, u), "joint positions q: found a vector of size 1, wanted size ");
  EXPECT_REX_ERROR(springEnergy(model, u), "joint positions q: found a vector of size 1, wanted size ");
  EXPECT_REX_ERROR(addSpringForces(model, model.initialPositions(), u),
                   "joint forces u: found a vector of size 1, wanted size ");
}

}  // namespace rex::joint_springs_test
