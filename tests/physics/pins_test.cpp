// Loops that pins close: Bullet's rows against our dynamics with constraints.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "dynamics/loop_dynamics.h"
#include "geometry/rotation.h"
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

// Three pins weld: a pendulum that carries a box of its own swings as the one to which the box is fixed.
TEST(PhysicsPins, WeldBodiesInThreePoints) {
  const auto pendulum = [](bool isOne) {
    SceneSpec spec;
    addHinged(spec, "arm", 1, 0.02).axis = {1, 0, 0};
    spec.joints[0].X_MC = translation(0, 0.5, 0);
    addLoose(spec, "box", 2, boxShape(0.1, 0.2, 0.3), translation(0.1, 0.8, 0));
    if (isOne) {
      spec.joints.resize(1);
      JointSpec& fixed = spec.joints.emplace_back();
      fixed.name = "fixed", fixed.parent = "arm", fixed.child = "box";
      fixed.type = JointType::kRigid;
      fixed.X_PF = translation(0.1, 0.3, 0);
      return spec;
    }
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(0.1, 0, 0), {-0.1, 0.1, 0}, {-0.1, -0.1, 0}})
      spec.pins.push_back({.a = "arm", .b = "box", .p_AP = Eigen::Vector3d(0.1, 0.3, 0) + p, .p_BQ = p});
    return spec;
  };
  const Model model = compile(pendulum(false));
  PhysicsWorld welded(model, kBare), one(compile(pendulum(true)), kBare);
  double apart = 0;
  for (int k = 0; k < 1000; ++k) {
    welded.step(1e-3);
    one.step(1e-3);
    apart = std::max(apart, gap(model, welded.state().q));
  }
  EXPECT_LT(apart, 1e-3) << "metres";
  EXPECT_GT(std::abs(one.state().q[0]), 1) << "it swings";
  EXPECT_NEAR(welded.state().q[0], one.state().q[0], 0.02);
}

// Trees of all kinds of joints, some of which follow others, pinned where they are: to each other, to
// themselves and to the world.
TEST(PhysicsPins, AccelerateRandomTreesAsOurDynamics) {
  Rng rng(5);
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 20; ++k) {
    SceneSpec spec = randomScene(rng, 13);
    JointSpec base;
    base.name = "base";
    base.parent = kWorldName;
    base.child = "b0";
    base.type = k % 2 == 0 ? JointType::kFree : JointType::kHinge;
    spec.joints.push_back(base);
    addHinged(spec, "apart", 1, 0.2);
    const auto hinge = std::ranges::find(spec.joints, JointType::kHinge, &JointSpec::type);
    hinge->mimic = "apart";
    hinge->mimicRatio = rng.normal();
    const auto pin = [&](const std::string& a, const std::string& b) {
      const Eigen::Vector3d p_AP = rng.normalVector(3);
      const Pose X_BA =
          b == kWorldName ? initialPose(spec, a) : initialPose(spec, b).inverse() * initialPose(spec, a);
      spec.pins.push_back({.a = a, .b = b, .p_AP = p_AP, .p_BQ = X_BA * p_AP});
    };
    pin("b12", k % 3 == 0 ? kWorldName : k % 3 == 1 ? "b0" : "apart");
    if (k % 4 == 0) pin("b10", "b11");
    const Model model = compile(spec);
    const std::vector<TaskMap> loops = pinTasks(model);
    State state{model.initialPositions(), rng.normalVector(model.nv())};
    state = closedState(model, state, loops);
    const VectorXd u = rng.normalVector(model.nv());
    // Bullet's velocities fit the posture before the step.
    const State after = closedState(model, stepped(model, state, u, kStep), loops);
    const VectorXd theirs = (after.v - state.v) / kStep, ours = loopDynamics(model, state, loops, u).a;
    EXPECT_LT((theirs - ours).norm(), 1e-3 * ours.norm()) << k;
  }
}

// What they leave open is of first order in the step.
TEST(PhysicsPins, StayTogetherToFirstOrder) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const auto gapAt = [&](double h) {
    PhysicsWorld world(model, kBare);
    world.setState({bar.closedForm(1), VectorXd::Zero(3)});
    for (int k = 0; k < std::lround(0.5 / h); ++k) world.step(h);
    return gap(model, world.state().q);
  };
  EXPECT_NEAR(gapAt(1e-3) / gapAt(5e-4), 2, 0.2);
}

TEST(PhysicsPins, CloseGapsAtTheStartSlowly) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  PhysicsOptions floating = kBare;
  floating.gravity_W.setZero();
  PhysicsWorld world(model, floating);
  State state{bar.closedForm(1), VectorXd::Zero(3)};
  state.q[2] += 0.3;
  world.setState(state);
  const double before = gap(model, state.q);
  double fastest = 0;
  for (int k = 0; k < 500; ++k) {
    world.step(1e-3);
    fastest = std::max(fastest, world.state().v.lpNorm<Eigen::Infinity>());
  }
  EXPECT_GT(before, 0.2);
  EXPECT_LT(gap(model, world.state().q), 1e-3);
  EXPECT_LT(fastest, 10) << "rad/s";
}

// The same state gives the same steps, whatever came before.
TEST(PhysicsPins, ForgetThePast) {
  const FourBar bar;
  const Model model = compile(bar.scene());
  const State state{bar.closedForm(1), VectorXd::Zero(3)};
  PhysicsWorld used(model, kBare), fresh(model, kBare);
  used.setState({bar.closedForm(2), VectorXd::Zero(3)});
  used.step(0.1);
  for (PhysicsWorld* world : {&used, &fresh}) {
    world->setState(state);
    world->step(0.1);
  }
  EXPECT_EQ(used.state().q, fresh.state().q);
}

// A door swings on its tilted hinge whether or not a second pin is on its axis, also one that nothing could
// close.
TEST(PhysicsPins, OfNoEffectHoldNothing) {
  const auto door = [](const std::vector<PinSpec>& pins) {
    SceneSpec spec;
    JointSpec& joint = addHinged(spec, "door", 3, 0.1);
    joint.X_PF = rotation(0.4, Eigen::Vector3d(1, 2, 0.5).normalized());
    spec.bodies[0].p_BBcm = {0.4, 0.1, 0.2};
    spec.pins = pins;
    const Model model = compile(spec);
    PhysicsWorld world(model, kBare);
    world.step(0.5);
    return world.state().q[0];
  };
  const double free = door({});
  EXPECT_GT(std::abs(free), 0.5);
  const Eigen::Vector3d above(0, 0.7, 0);
  const Pose X_WF = rotation(0.4, Eigen::Vector3d(1, 2, 0.5).normalized());
  EXPECT_NEAR(door({{.a = "door", .b = kWorldName, .p_AP = above, .p_BQ = X_WF * above}}), free, 0.01);
  EXPECT_NEAR(door({{.a = "door", .b = kWorldName, .p_AP = above, .p_BQ = X_WF * Eigen::Vector3d(0, 1, 0)}}),
              free, 0.01)
      << "the gap is along the axis";
}

// A box on a free joint that a pin holds by its top hangs still; a pin between two fixed bodies has no
// effect.
TEST(PhysicsPins, HangBodiesOnTheWorld) {
  SceneSpec spec;
  addLoose(spec, "box", 1, boxShape(0.1, 0.1, 0.4), translation(0, 0, -0.2));
  BodySpec post;
  post.name = "post";
  spec.bodies.push_back(post);
  spec.pins = {{.a = kWorldName, .b = "box", .p_BQ = {0, 0, 0.2}}, {.a = kWorldName, .b = "post"}};
  const Model model = compile(spec);
  PhysicsWorld world(model);
  const State state = world.state();
  world.step(1);
  EXPECT_LT(gap(model, world.state().q), 1e-4);
  EXPECT_LT((world.state().q - state.q).norm(), 1e-3);
}

}  // namespace rex::pins_test
