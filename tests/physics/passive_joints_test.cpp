// Armatures and springs of joints, in Bullet and in our own motion of what nothing touches.
#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "dynamics/joint_springs.h"
#include "dynamics/stepper.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/random_scene.h"

namespace rex::passive_joints_test {

using Eigen::VectorXd;

// A tree on a free joint, without screws, and with some joints that follow others.
SceneSpec randomTree(Rng& rng, int bodies, bool isFree) {
  SceneSpec spec = randomScene(rng, bodies);
  std::string leader;
  for (JointSpec& joint : spec.joints) {
    if (joint.type == JointType::kScrew) joint.type = JointType::kHinge;
    if (joint.type != JointType::kHinge) continue;
    if (!leader.empty()) joint.mimic = leader, joint.mimicRatio = rng.uniform(-1, 1);
    leader = leader.empty() ? joint.name : "";
  }
  if (isFree) {
    JointSpec root{.name = "root", .parent = "world", .child = "b0", .X_PF = {}, .X_MC = {}};
    root.type = JointType::kFree;
    root.X_PF = randomPose(rng), root.X_MC = randomPose(rng);
    spec.joints.push_back(root);
  }
  return spec;
}

// How far apart Bullet and semi-implicit Euler are after `count` steps, relative to the change of v; of first
// order in the step.
double apart(const Model& model, const State& start, int count, double h) {
  PhysicsWorld world(model);
  world.setState(start);
  Stepper stepper(model, {.integrator = Integrator::kSemiImplicitEuler});
  State ours = start;
  for (int i = 0; i < count; ++i) {
    world.step(h);
    stepper.step(ours, VectorXd::Zero(model.nv()), h);
  }
  return (world.state().v - ours.v).norm() / (ours.v - start.v).norm();
}

State randomStart(Rng& rng, const Model& model) {
  const VectorXd zero = VectorXd::Zero(model.nv());
  return {integrate(model, randomPositions(rng, model.nq()), zero), 0.3 * rng.normalVector(model.nv())};
}

TEST(PassiveJoints, HaveArmaturesInBullet) {
  for (const double armature : {0.01, 1., 100.}) {
    Rng rng(1);
    for (int i = 0; i < 10; ++i) {
      SceneSpec spec = randomTree(rng, 3 + i, i % 2 == 0);
      for (JointSpec& joint : spec.joints) joint.armature = armature * rng.uniform(0.5, 1);
      const Model model = compile(spec);
      EXPECT_LT(apart(model, randomStart(rng, model), 100, 5e-4), 1e-3) << armature << ", tree " << i;
    }
  }
}

TEST(PassiveJoints, HaveSpringsInBullet) {
  Rng rng(2);
  for (int i = 0; i < 10; ++i) {
    SceneSpec spec = randomTree(rng, 3 + i, i % 2 == 0);
    for (JointSpec& joint : spec.joints) {
      joint.stiffness = rng.uniform(1, 20);
      if (i % 3 == 0 && joint.type != JointType::kRigid)
        joint.springReference = 0.1 * VectorXd::Ones(positionCount(joint.type));
    }
    const Model model = compile(spec);
    EXPECT_LT(apart(model, randomStart(rng, model), 50, 1e-3), 1e-3) << i;
  }
}

// A body of its own on a free joint, with all at once.
TEST(PassiveJoints, HoldFreeBodies) {
  Rng rng(3);
  SceneSpec spec;
  addLoose(spec, "box", 2, boxShape(0.2, 0.3, 0.4), {});
  JointSpec& joint = spec.joints[0];
  joint.X_PF = randomPose(rng), joint.X_MC = randomPose(rng);
  joint.armature = 0.7, joint.stiffness = 30;
  const Model model = compile(spec);
  EXPECT_LT(apart(model, randomStart(rng, model), 200, 5e-4), 2e-3);
}

TEST(PassiveJoints, CarryBuoyantBodiesInBullet) {
  Rng rng(4);
  for (int i = 0; i < 10; ++i) {
    SceneSpec spec = randomTree(rng, 3 + i, i % 2 == 0);
    for (BodySpec& body : spec.bodies) body.buoyancy = rng.uniform(-2, 4);
    const Model model = compile(spec);
    EXPECT_LT(apart(model, randomStart(rng, model), 50, 1e-3), 1e-3) << i;
  }
  SceneSpec spec;
  addLoose(spec, "box", 2, boxShape(0.2, 0.3, 0.4), {});
  spec.bodies[0].p_BBcm = {0.1, 0.2, 0.3};
  spec.bodies[0].buoyancy = 1;
  const Model model = compile(spec);
  PhysicsWorld world(model);
  for (int i = 0; i < 500; ++i) world.step(1e-3);
  EXPECT_EQ(world.state().q, initialState(model).q);
}

// However stiff, a spring is no explosion: it comes to rest where its force bears the load.
TEST(PassiveJoints, StayTameHoweverStiffTheyAre) {
  for (const JointType type : {JointType::kHinge, JointType::kSlider, JointType::kBall, JointType::kFree}) {
    for (const double stiffness : {1e5, 1e6, 1e7, 1e9, 1e12}) {
      SceneSpec spec;
      addHinged(spec, "one", 1, 0.02).X_MC = translation(0.3, 0, 0);
      addHinged(spec, "two", 1, 0.02).parent = "one";
      for (JointSpec& joint : spec.joints) joint.stiffness = stiffness;
      spec.joints[0].type = type;
      const Model model = compile(spec);
      PhysicsWorld world(model);
      State start = initialState(model);
      start.v.setConstant(0.1);
      world.setState(start);
      const double before = energy(model, start.q, start.v).total();
      for (int i = 0; i < 500; ++i) {
        world.step(1e-3);
        const State now = world.state();
        ASSERT_LT(energy(model, now.q, now.v).total() - before, 0.01)
            << toString(type) << ' ' << stiffness << ' ' << i;
      }
      if (stiffness < 1e9) continue;
      EXPECT_LT(world.state().v.norm(), 1e-3) << toString(type) << ' ' << stiffness;
    }
  }
}

// An arm of hinges that nothing touches: by our own dynamics.
TEST(PassiveJoints, KeepTheirEnergyWithoutContact) {
  for (const double stiffness : {10., 1e3, 1e5}) {
    SceneSpec spec;
    for (const char* name : {"a", "b", "c"}) {
      JointSpec& joint = addHinged(spec, name, 1, 0.02);
      joint.X_MC = translation(0.3, 0, 0);
      joint.armature = 0.05, joint.stiffness = stiffness;
      if (*name != 'a') joint.parent = std::string(1, static_cast<char>(*name - 1));
    }
    const Model model = compile(spec);
    PhysicsWorld world(model);
    const State start{VectorXd::Constant(3, 0.1), VectorXd::Zero(3)};
    world.setState(start);
    const double before = energy(model, start.q, start.v).total();
    double kinetic = 0, worst = 0;
    for (int i = 0; i < 2000; ++i) {
      world.step(1e-3);
      const State now = world.state();
      const Energy at = energy(model, now.q, now.v);
      kinetic = std::max(kinetic, at.kinetic);
      worst = std::max(worst, std::abs(at.total() - before));
    }
    EXPECT_LT(worst, 1e-3 * kinetic) << stiffness;
  }
}

// Without bounce, both move on together: as if the armature were a mass of the pusher.
TEST(PassiveJoints, PushWithTheirArmature) {
  SceneSpec spec;
  addLoose(spec, "ball", 1, ballShape(0.1), {});
  addHinged(spec, "pusher", 1, 1);
  JointSpec& joint = spec.joints[1];
  joint.type = JointType::kSlider;
  joint.axis = Eigen::Vector3d::UnitX();
  joint.X_MC = translation(-0.21, 0, 0);
  joint.armature = 9;
  ShapeSpec ball = spec.bodies[0].shapes[0];
  ball.name = "pusher";
  spec.bodies[1].shapes.push_back(ball);
  PhysicsWorld world(compile(spec), {.gravity_W = {0, 0, 0}});
  State start = world.state();
  start.v[6] = 1;
  world.setState(start);
  for (int i = 0; i < 50; ++i) world.step(1e-3);
  EXPECT_NEAR(world.state().v[0], 10. / 11, 1e-3);
  EXPECT_NEAR(world.state().v[6], 10. / 11, 1e-3);
}

// A motor that may push with 1 N m accelerates mass and armature together.
TEST(PassiveJoints, SlowMotors) {
  for (const bool isAlone : {true, false}) {
    SceneSpec spec;
    addHinged(spec, "wheel", 1, 0.1).armature = 0.4;
    if (!isAlone) addLoose(spec, "elsewhere", 1, ballShape(0.1), translation(9, 0, 0));
    PhysicsWorld world(compile(spec));
    std::vector<Motor> motors(isAlone ? 1 : 7);
    motors[0] = {Motor::Kind::kVelocity, 100, 1};
    world.setMotors(motors);
    for (int i = 0; i < 100; ++i) world.step(1e-3);
    EXPECT_NEAR(world.state().v[0], 0.2, 1e-6);
  }
}

}  // namespace rex::passive_joints_test
