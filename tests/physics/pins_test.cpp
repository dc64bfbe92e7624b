// Loops that pins close: Bullet's rows against our dynamics with constraints.
#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "dynamics/loop_dynamics.h"
#include "kinematics/closed_loops.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "scene/scene_edit.h"
#include "support/four_bar.h"
#include "support/random_scene.h"

namespace rex::pins_test {

using Eigen::VectorXd;

const PhysicsOptions kBare{.jointLimits = false, .jointFriction = false};

double gap(const Model& model, const VectorXd& q) {
  return stackLoops(model, pinTasks(model), q).y.lpNorm<Eigen::Infinity>();
}

double total(const Model& model, const State& state) {
  const Energy of = energy(model, state.q, state.v);
  return of.kinetic + of.potential;
}

// A four-bar whose crank turns freely, against loopDynamics() in steps of a tenth of a millisecond.
TEST(PhysicsPins, SwingAFourBarAsOurDynamics) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const std::vector<TaskMap> loops = pinTasks(model);
  PhysicsWorld world(model, kBare);
  State ours{bar.closedForm(1), VectorXd::Zero(3)};
  world.setState(ours);
  const double before = total(model, ours);
  double apart = 0, difference = 0, change = 0;
  for (int k = 1; k <= 1000; ++k) {
    world.step(1e-3);
    for (int i = 0; i < 10; ++i) {
      ours.v += 1e-4 * loopDynamics(model, ours, loops, VectorXd::Zero(3)).a;
      ours.q += 1e-4 * ours.v;
      if (i == 9) ours = closedState(model, ours, loops);
    }
    const State theirs = world.state();
    apart = std::max(apart, gap(model, theirs.q));
    difference = std::max(difference, (theirs.q - ours.q).lpNorm<Eigen::Infinity>());
    change = std::max(change, std::abs(total(model, theirs) - before));
  }
  EXPECT_LT(apart, 2e-4) << "metres";
  EXPECT_LT(difference, 0.02) << "radians, of " << std::abs(ours.q[0] - 1) << " that the crank has turned";
  EXPECT_LT(change, 0.02 * std::abs(before));
  EXPECT_GT(std::abs(ours.q[0] - 1), 1) << "it moves";
}

// Trees of all kinds of joints, pinned where they are: to each other, to themselves and to the world.
TEST(PhysicsPins, AccelerateRandomTreesAsOurDynamics) {
  Rng rng(5);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 20; ++k) {
    SceneSpec spec = randomScene(rng, 6);
    JointSpec base;
    base.name = "base";
    base.parent = kWorldName;
    base.child = "b0";
    base.type = k % 2 == 0 ? JointType::kFree : JointType::kHinge;
    spec.joints.push_back(base);
    addHinged(spec, "apart", 1, 0.2);
    const auto pin = [&](const std::string& a, const std::string& b) {
      const Eigen::Vector3d p_AP = rng.normalVector(3);
      const Pose X_BA =
          b == "world" ? initialPose(spec, a) : initialPose(spec, b).inverse() * initialPose(spec, a);
      spec.pins.push_back({.a = a, .b = b, .p_AP = p_AP, .p_BQ = X_BA * p_AP});
    };
    pin("b5", k % 3 == 0 ? "world" : k % 3 == 1 ? "b0" : "apart");
    if (k % 4 == 0) pin("b3", "b4");
    const Model model = compile(spec);
    const std::vector<TaskMap> loops = pinTasks(model);
    State state{model.initialPositions(), rng.normalVector(model.nv())};
    state = closedState(model, state, loops);
    const VectorXd u = rng.normalVector(model.nv());
    PhysicsWorld world(model, kBare);
    world.setState(state);
    std::vector<Motor> motors;
    for (const double force : u) motors.push_back({.target = force});
    world.setMotors(motors);
    world.step(kStep);
    // Bullet's velocities fit the posture before the step.
    const State after = closedState(model, world.state(), loops);
    const VectorXd theirs = (after.v - state.v) / kStep, ours = loopDynamics(model, state, loops, u).a;
    EXPECT_LT((theirs - ours).norm(), 1e-3 * ours.norm()) << k;
  }
}

// Without a step between, gaps at the start close at 200 /s.
TEST(PhysicsPins, CloseGaps) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  PhysicsWorld world(model,
                     {.gravity_W = Eigen::Vector3d::Zero(), .jointLimits = false, .jointFriction = false});
  State state{bar.closedForm(1), VectorXd::Zero(3)};
  state.q[2] += 0.01;
  world.setState(state);
  const double before = gap(model, state.q);
  world.step(0.02);
  EXPECT_LT(gap(model, world.state().q), 0.03 * before);
}

// A box on a free joint that a pin holds by its corner swings as a pendulum; one that pins hold at two fixed
// bodies is of no effect.
TEST(PhysicsPins, HangBodiesOnTheWorld) {
  SceneSpec spec;
  addLoose(spec, "box", 1, boxShape(0.1, 0.1, 0.4), translation(0, 0, -0.2));
  BodySpec post;
  post.name = "post";
  spec.bodies.push_back(post);
  spec.pins = {{.a = "world", .b = "box", .p_AP = {0, 0, 0}, .p_BQ = {0, 0, 0.2}},
               {.a = "world", .b = "post"}};
  const Model model = compile(spec);
  PhysicsWorld world(model);
  State state = world.state();
  state.v[model[model[model.body("box")].joint].vIndex] = 0;
  world.setState(state);
  world.step(1);
  EXPECT_LT(gap(model, world.state().q), 1e-4) << "it hangs still";
  EXPECT_LT((world.state().q - state.q).norm(), 1e-3);
}

}  // namespace rex::pins_test
