#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "dynamics/stepper.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::joint_forces_test {

constexpr double kMass = 2, kDamping = 0.7, kFriction = 0.9;
const Eigen::VectorXd kNoForce = Eigen::VectorXd::Zero(1);

// A body of 2 kg and 2 kg m^2 on a joint along or about x.
Model oneJoint(JointType type, double damping, double friction) {
  BodySpec body{.name = "body", .X_WB = {}, .mass = kMass};
  body.inertia = kMass * Eigen::Matrix3d::Identity();
  JointSpec joint{.name = "joint", .parent = "world", .child = "body", .type = type, .X_PF = {}, .X_MC = {}};
  joint.lower = Eigen::VectorXd::Constant(1, -1);
  joint.upper = Eigen::VectorXd::Constant(1, 1);
  joint.damping = damping;
  joint.friction = friction;
  return compile({.name = "one", .bodies = {body}, .joints = {joint}, .worldShapes = {}});
}

State moving(double q, double v) {
  return {Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, v)};
}

TEST(JointForces, DampingSlowsExponentially) {
  for (const JointType type : {JointType::kHinge, JointType::kSlider}) {
    const Model model = oneJoint(type, kDamping, 0);
    Stepper stepper(model, {.jointForces = {.friction = true}});
    State state = moving(0, 3);
    for (int i = 0; i < 100; ++i) stepper.step(state, kNoForce, 0.02);
    const double decay = std::exp(-kDamping * 2 / kMass);
    EXPECT_NEAR(state.v[0], 3 * decay, 1e-9);
    EXPECT_NEAR(state.q[0], 3 * kMass / kDamping * (1 - decay), 1e-9);
  }
}

// m v' = -f tanh(v / s) has the solution sinh(v / s) = sinh(v0 / s) exp(-f t / (m s)).
TEST(JointForces, FrictionStopsAsItsClosedForm) {
  const Model model = oneJoint(JointType::kSlider, 0, kFriction);
  const double s = 0.1, v0 = 0.4;
  Stepper stepper(model, {.jointForces = {.friction = true, .frictionSpeed = s}});
  State state = moving(0, v0);
  for (int i = 0; i < 1000; ++i) {
    stepper.step(state, kNoForce, 0.001);
    const double v = s * std::asinh(std::sinh(v0 / s) * std::exp(-kFriction * state.time / (kMass * s)));
    ASSERT_NEAR(state.v[0], v, 1e-10) << state.time;
  }
  EXPECT_LT(state.v[0], 0.1);
}

// From rest beyond a limit until it is reached: part of an oscillation, damped or not.
TEST(JointForces, LimitsAreSpringsAndDampers) {
  const Model model = oneJoint(JointType::kSlider, 0, 0);
  const double stiffness = 50, depth = 0.2;
  for (const double sign : {1., -1.}) {
    for (const double damping : {0., 3.}) {
      Stepper stepper(model, {.jointForces = {.limitStiffness = stiffness, .limitDamping = damping}});
      const double rate = damping / (2 * kMass), w = std::sqrt(stiffness / kMass - rate * rate);
      State state = moving(sign * (1 + depth), 0);
      for (double wanted = depth; wanted > 0.01;) {
        stepper.step(state, kNoForce, 1e-3);
        const double t = state.time;
        wanted = depth * std::exp(-rate * t) * (std::cos(w * t) + rate / w * std::sin(w * t));
        ASSERT_NEAR(sign * state.q[0] - 1, wanted, 1e-11) << t;
      }
      EXPECT_GT(state.time, 0.9 / w);
    }
  }
}

TEST(JointForces, AreThereOnlyWhenAskedFor) {
  const Model model = oneJoint(JointType::kSlider, kDamping, kFriction);
  const auto force = [&](const State& state, const JointForces& forces) {
    return jointForces(model, state.q, state.v, forces)[0];
  };
  EXPECT_EQ(force(moving(3, 2), {}), 0);
  EXPECT_NEAR(force(moving(3, 2), {.friction = true}), -2 * kDamping - kFriction, 1e-15);
  EXPECT_NEAR(force(moving(3, 0.01), {.friction = true}), -0.01 * kDamping - 0.76 * kFriction,
              0.002 * kFriction)
      << "three quarters of friction";
  EXPECT_EQ(force(moving(3, 2), {.limitStiffness = 10}), -20);
  EXPECT_EQ(force(moving(3, 2), {.limitDamping = 10}), -20);
  EXPECT_EQ(force(moving(-3, 2), {.limitStiffness = 10, .limitDamping = 1}), 18);
  EXPECT_EQ(force(moving(0.9, 2), {.limitStiffness = 10, .limitDamping = 1}), 0);
}

// With the lever of the ratio: the power of its force is that at the joint itself.
TEST(JointForces, JointsThatMimicHaveTheirOwn) {
  SceneSpec spec{.name = "two", .bodies = {}, .joints = {}, .worldShapes = {}};
  for (const char* name : {"a", "b"}) {
    spec.bodies.push_back({.name = name, .X_WB = {}, .mass = 1});
    JointSpec joint{
        .name = std::string("to-") + name, .parent = "world", .child = name, .X_PF = {}, .X_MC = {}};
    joint.damping = 1;
    joint.friction = 2;
    spec.joints.push_back(joint);
  }
  spec.joints[1].mimic = "to-a";
  spec.joints[1].mimicRatio = -3;
  const Eigen::VectorXd v = Eigen::VectorXd::Constant(1, 5);
  const Eigen::VectorXd u = jointForces(compile(spec), kNoForce, v, {.friction = true});
  ASSERT_EQ(u.size(), 1);
  EXPECT_NEAR(u[0] * v[0], -(5. * 5 + 2 * 5) - (15. * 15 + 2 * 15), 1e-12);
}

// Mechanical energy, without that in the springs of limits, which are not felt here.
TEST(JointForces, FrictionTakesEnergyFromAllJoints) {
  Rng rng(7);
  for (int tree = 0; tree < 5; ++tree) {
    SceneSpec spec = randomScene(rng, 13);
    for (JointSpec& joint : spec.joints) joint.damping = rng.uniform(), joint.friction = rng.uniform();
    const Model model = compile(spec);
    Stepper stepper(model, {.jointForces = {.friction = true, .frictionSpeed = 0.3}});
    State state{randomPositions(rng, model.nq()), rng.normalVector(model.nv())};
    double before = energy(model, state.q, state.v).total();
    for (int i = 0; i < 30; ++i) {
      stepper.step(state, Eigen::VectorXd::Zero(model.nv()), 0.002);
      const double now = energy(model, state.q, state.v).total();
      ASSERT_LT(now, before) << "tree " << tree << ", step " << i;
      before = now;
    }
  }
}

TEST(JointForces, RefusesNonsense) {
  const Model model = oneJoint(JointType::kSlider, 0, 0);
  const Eigen::VectorXd one = kNoForce, two = Eigen::VectorXd::Zero(2);
  EXPECT_REX_ERROR(jointForces(model, two, one, {}),
                   "joint positions q: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR(jointForces(model, one, two, {}), "joint velocities v: found a vector of size 2");
  Eigen::VectorXd u = two;
  EXPECT_REX_ERROR(jointForces(model, one, one, {}, u), "joint forces u: found a vector of size 2");
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double speed : {0., -1., kInfinity, std::nan("")}) {
    EXPECT_REX_ERROR(jointForces(model, one, one, {.friction = true, .frictionSpeed = speed}),
                     fmt::format("joint forces: friction speed: found {:g}, wanted a positive", speed));
  }
  for (const double bad : {-1., kInfinity, std::nan("")}) {
    EXPECT_REX_ERROR(jointForces(model, one, one, {.limitStiffness = bad}),
                     "joint forces: limit stiffness: found ");
    EXPECT_REX_ERROR(jointForces(model, one, one, {.limitDamping = bad}),
                     fmt::format("limit damping: found {:g}, wanted a finite number, 0 or more", bad));
    EXPECT_REX_ERROR(Stepper(model, {.jointForces = {.limitDamping = bad}}), "limit damping: found ");
  }
}

}  // namespace rex::joint_forces_test
