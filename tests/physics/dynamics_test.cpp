// Without contact, Bullet's articulated bodies are held against ours.
#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/paths.h"
#include "support/random_scene.h"

namespace rex::dynamics_test {

const PhysicsOptions kBare{.jointLimits = false, .jointFriction = false};

// Without screws, which Bullet does not know, and with inertias along no axis of the body.
SceneSpec randomTree(Rng& rng, int bodies, bool isFree) {
  SceneSpec spec = randomScene(rng, bodies);
  for (JointSpec& joint : spec.joints)
    if (joint.type == JointType::kScrew) joint.type = JointType::kHinge;
  for (BodySpec& body : spec.bodies) {
    const Eigen::Matrix3d R = expSO3(rng.normalVector(3));
    body.inertia = R * Eigen::Vector3d(rng.uniformVector(3, 0.1, 0.2)).asDiagonal() * R.transpose();
    body.inertia = (*body.inertia + body.inertia->transpose()) / 2;
  }
  if (isFree) {
    JointSpec root;
    root.name = "root";
    root.parent = "world";
    root.child = "b0";
    root.type = JointType::kFree;
    root.X_PF = randomPose(rng);
    root.X_MC = randomPose(rng);
    spec.joints.push_back(root);
  }
  return spec;
}

State randomState(Rng& rng, const Model& model) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.nv());
  return {integrate(model, randomPositions(rng, model.nq()), zero), rng.normalVector(model.nv()), 0};
}

// The largest difference of accelerations, as a share of the largest acceleration.
double accelerationError(const Model& model, const State& state, const Eigen::VectorXd& u) {
  constexpr double kStep = 1e-7;
  const Eigen::VectorXd bullet = (stepped(model, state, u, kStep).v - state.v) / kStep;
  const Eigen::VectorXd ours = forwardDynamics(model, state.q, state.v, u);
  return (bullet - ours).lpNorm<Eigen::Infinity>() / ours.lpNorm<Eigen::Infinity>();
}

// With a body that flies alone, Bullet moves all; else a robot moves by our own dynamics.
Model robotWithoutContact(const char* file, bool isAlone = false) {
  SceneSpec spec = readScene(sourcePath(file)).spec;
  for (BodySpec& body : spec.bodies)
    for (ShapeSpec& shape : body.shapes) shape.contact = false;
  for (ShapeSpec& shape : spec.worldShapes) shape.contact = false;
  if (!isAlone) {
    addLoose(spec, "elsewhere", 1, ballShape(0.1), translation(9, 0, 0));
    spec.bodies.back().shapes.back().contact = false;
  }
  return compile(spec);
}

TEST(PhysicsDynamics, GivesBackTheState) {
  Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const Model model = compile(randomTree(rng, 14, i % 2 == 0));
    PhysicsWorld world(model, kBare);
    State state = randomState(rng, model);
    state.time = 2.5;
    world.setState(state);
    const State back = world.state();
    EXPECT_LT(difference(model, state.q, back.q).norm(), 1e-12);
    EXPECT_LT((state.v - back.v).norm(), 1e-12);
    EXPECT_EQ(back.time, 2.5);
  }
}

// Rays along the axes of a small box on every body meet its faces where forward kinematics says.
TEST(PhysicsDynamics, PutsBodiesWhereForwardKinematicsDoes) {
  Rng rng(2);
  for (int i = 0; i < 10; ++i) {
    SceneSpec spec = randomTree(rng, 12, i % 2 == 0);
    for (BodySpec& body : spec.bodies) {
      ShapeSpec& shape = body.shapes.emplace_back();
      shape.X_BS = randomPose(rng);
      shape.shape = boxShape(0.02, 0.04, 0.06);
      shape.contact = true;
    }
    const Model model = compile(spec);
    PhysicsWorld world(model, kBare);
    const State state = randomState(rng, model);
    world.setState(state);
    const BodyPoses poses = forwardKinematics(model, state.q);
    for (std::size_t k = 0; k < model.shapes().size(); ++k) {
      const Pose X_WS = poses[model.shapes()[k].body] * model.shapes()[k].X_BS;
      for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.01 * (axis + 1);
        const auto hit = world.rayCast(X_WS * (2 * half * Eigen::Vector3d::Unit(axis)), X_WS.p);
        ASSERT_TRUE(hit) << k;
        EXPECT_EQ(hit->shape, static_cast<int>(k));
        EXPECT_LT((hit->p_WQ - X_WS * (half * Eigen::Vector3d::Unit(axis))).norm(), 1e-9);
        EXPECT_LT((hit->normal_W - X_WS.R.col(axis)).norm(), 1e-9);
      }
    }
  }
}

TEST(PhysicsDynamics, AcceleratesRandomTreesAsWeDo) {
  Rng rng(3);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Model model = compile(randomTree(rng, 2 + i % 13, i % 2 == 0));
    worst = std::max(worst, accelerationError(model, randomState(rng, model), rng.normalVector(model.nv())));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 1e-6);
}

class PhysicsRobots : public testing::TestWithParam<const char*> {};

TEST_P(PhysicsRobots, AccelerateAsOurs) {
  Rng rng(4);
  const Model model = robotWithoutContact(GetParam());
  for (int i = 0; i < 5; ++i) {
    State state{integrate(model, model.initialPositions(), 0.3 * rng.normalVector(model.nv())),
                rng.normalVector(model.nv()), 0};
    EXPECT_LT(accelerationError(model, state, rng.normalVector(model.nv())), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(All, PhysicsRobots,
                         testing::Values("data/robots/arm3.ors", "data/robots/arm7.ors",
                                         "data/robots/arm7dof/arm7dof.urdf",
                                         "data/robots/balancer/balancer.urdf",
                                         "data/robots/humanoid/humanoid.urdf", "data/robots/man.ors",
                                         "data/robots/pegArm.ors", "data/robots/pegArm2.ors",
                                         "data/robots/quadruped/quadruped.urdf"));

// Bullet steps v first, then q with the new v: the first-order error shrinks with the step.
TEST(PhysicsDynamics, SwingsLikeRungeKutta) {
  const Model model = robotWithoutContact("data/robots/arm3.ors");
  const auto error = [&](double h) {
    PhysicsWorld world(model, kBare);
    Stepper stepper(model);
    State ours = initialState(model);
    for (int i = 0; i < static_cast<int>(std::lround(0.5 / h)); ++i) {
      world.step(h);
      stepper.step(ours, Eigen::VectorXd::Zero(model.nv()), h);
    }
    return (world.state().q - ours.q).norm();
  };
  const double coarse = error(1e-3), fine = error(5e-4);
  EXPECT_LT(coarse, 0.05);
  EXPECT_NEAR(coarse / fine, 2, 0.2);
}

// Friction of joints switched off, nothing near: it swings for ten seconds, and its lightest links spin.
TEST(PhysicsDynamics, AnUntouchedArmKeepsItsEnergy) {
  const Model model = robotWithoutContact("data/robots/arm7dof/arm7dof.urdf", true);
  PhysicsWorld world(model, kBare);
  State ours = initialState(model);
  ours.q.setConstant(0.3);
  world.setState(ours);
  Stepper stepper(model, {.integrator = Integrator::kBeeman});
  const double before = energy(model, ours.q, ours.v).total();
  double mostKinetic = 0, worst = 0;
  for (int i = 0; i < 10'000; ++i) {
    world.step(1e-3);
    const State state = world.state();
    if (i < 100) {
      stepper.step(ours, Eigen::VectorXd::Zero(model.nv()), 1e-3);
      EXPECT_EQ(state.q, ours.q);
      EXPECT_EQ(state.v, ours.v);
    }
    const Energy now = energy(model, state.q, state.v);
    mostKinetic = std::max(mostKinetic, now.kinetic);
    worst = std::max(worst, std::abs(now.total() - before));
  }
  RecordProperty("drift", std::to_string(worst / mostKinetic));
  EXPECT_LT(worst, 1e-3 * mostKinetic);
}

// Motors of both kinds, friction, damping and limits: exactly and together here, and by Bullet, which a body
// elsewhere makes move the arm, in iterations that start from the step before. Both are of first order.
TEST(PhysicsDynamics, JointsAreDrivenAndHeldAsInBullet) {
  const char* const file = "data/robots/arm7dof/arm7dof.urdf";
  const Model alone = robotWithoutContact(file, true), crowded = robotWithoutContact(file);
  PhysicsWorld world(alone, {.iterations = 200}), bullets(crowded, {.iterations = 200});
  std::vector<Motor> motors(static_cast<std::size_t>(alone.nv()));
  motors[0] = {Motor::Kind::kVelocity, 0.5, 20};
  motors[1] = {Motor::Kind::kPosition, 0.8, 30};  // too weak to hold it everywhere
  motors[2] = {Motor::Kind::kForce, 1};
  motors[4] = {Motor::Kind::kVelocity, 2, 1e6};  // reaches its limit and is stopped there
  world.setMotors(motors);
  motors.insert(motors.begin(), 6, Motor{});  // of the body elsewhere
  bullets.setMotors(motors);
  double farthest = 0, worst = 0;
  for (int i = 0; i < 2000; ++i) {
    world.step(1e-3);
    bullets.step(1e-3);
    const State ours = world.state(), theirs = bullets.state();
    worst = std::max(worst, (ours.q - theirs.q.tail(alone.nq())).lpNorm<Eigen::Infinity>());
    farthest = std::max(farthest, ours.q.lpNorm<Eigen::Infinity>());
  }
  EXPECT_GT(farthest, 1);
  EXPECT_LT(worst, 1e-5);
  EXPECT_GT(worst, 0);  // or Bullet would have moved both
}

// A triple pendulum of blades 3 mm apart: nothing touches, but what is so near counts as if it could.
// Bullet's own motion would gain and lose 4 % of the energy in steps of a millisecond. With `isStopped`, the
// last joint is thrown from limit to limit, where it may only lose energy.
TEST(PhysicsDynamics, KeepsTheEnergyOfWhatIsNear) {
  for (const bool isStopped : {false, true}) {
    SceneSpec spec;
    for (int i = 0; i < 3; ++i) {
      const std::string name(1, static_cast<char>('a' + i));
      JointSpec& joint = addHinged(spec, name, 1, 0.01);
      if (i > 0) joint.parent = std::string(1, static_cast<char>('a' + i - 1));
      joint.X_PF = translation(0, i == 0 ? 0 : 0.003, i == 0 ? 0 : -0.2);
      joint.X_MC = translation(0, 0, -0.2);
      ShapeSpec& blade = spec.bodies.back().shapes.emplace_back();
      blade.shape = boxShape(0.05, 0.002, 0.4);
      blade.contact = true;
    }
    if (isStopped) spec.joints[2].lower = spec.joints[2].upper = Eigen::VectorXd::Zero(1);
    if (isStopped) spec.joints[2].lower[0] = -0.3, spec.joints[2].upper[0] = 0.3;
    const Model model = compile(spec);
    PhysicsWorld world(model);
    const State start{Eigen::Vector3d(2.5, 0.2, -0.2), Eigen::Vector3d::Zero()};
    world.setState(start);
    const double before = energy(model, start.q, start.v).total();
    double least = before, most = before, rise = 0, kinetic = 0;
    for (int i = 0; i < 3000; ++i) {
      world.step(1e-3);
      ASSERT_TRUE(world.contacts().empty());
      const State now = world.state();
      const Energy at = energy(model, now.q, now.v);
      kinetic = std::max(kinetic, at.kinetic);
      least = std::min(least, at.total());
      most = std::max(most, at.total());
      rise = std::max(rise, at.total() - least);
    }
    EXPECT_LT(rise, (isStopped ? 3e-3 : 1e-3) * kinetic);
    if (!isStopped) {
      EXPECT_LT(most - least, 1e-3 * kinetic);
    }
  }
}

// A pendulum falls to the ground, on its own dynamics at first, then on Bullet's: no jump between them, and
// the same contact as with a body elsewhere, when all is Bullet's.
TEST(PhysicsDynamics, HandsOverWhatTouches) {
  SceneSpec spec;
  addHinged(spec, "wheel", 1, 0.1);
  JointSpec& joint = addHinged(spec, "bob", 1, 1e-3);
  joint.parent = "wheel";
  joint.X_MC = translation(0.5, 0, 0);
  ShapeSpec& ball = spec.bodies.back().shapes.emplace_back();
  ball.shape = ballShape(0.1);
  ball.contact = true;
  addGround(spec, translation(0, 0, -0.4));
  SceneSpec crowded = spec;
  addLoose(crowded, "elsewhere", 1, ballShape(0.1), translation(9, 0, 9));
  PhysicsWorld world(compile(spec)), bullets(compile(crowded));
  const auto begins = [](PhysicsWorld& one, int& at, int step) {
    one.step(1e-3);
    if (at < 0 && !one.events().empty()) at = step;
  };
  int first = -1, firstOfBullet = -1;
  State last = world.state();
  double lastOfBullet = bullets.state().v[7];  // after the free joint
  for (int i = 0; i < 1000; ++i) {
    begins(world, first, i);
    begins(bullets, firstOfBullet, i);
    const State now = world.state();
    const double ofBullet = bullets.state().v[7];
    if (first < 0 && firstOfBullet < 0) {
      EXPECT_NEAR(now.v[1] - last.v[1], ofBullet - lastOfBullet, 5e-5) << i;
      EXPECT_NEAR(now.q[1] - last.q[1], 1e-3 * (now.v[1] + last.v[1]) / 2, 2e-5) << i;
    }
    last = now;
    lastOfBullet = ofBullet;
  }
  EXPECT_GT(first, 100) << world.state().q.transpose();
  EXPECT_NEAR(first, firstOfBullet, 2);
  ASSERT_EQ(world.contacts().size(), bullets.contacts().size());
  EXPECT_NEAR(world.state().q[1], bullets.state().q[8], 1e-4);
  EXPECT_NEAR(world.contacts()[0].impulse, bullets.contacts()[0].impulse, 1e-5);
}

TEST(PhysicsDynamics, PendulumKeepsItsEnergy) {
  SceneSpec spec;
  addHinged(spec, "bob", 1, 1e-3).X_MC = translation(0.5, 0, 0);
  const Model model = compile(spec);
  PhysicsWorld world(model);
  const double before = energy(model, world.state().q, world.state().v).total();
  double worst = 0;
  for (int i = 0; i < 20'000; ++i) {
    world.step(5e-4);
    const State state = world.state();
    worst = std::max(worst, std::abs(energy(model, state.q, state.v).total() - before));
  }
  EXPECT_LT(worst, 0.01 * 9.81 * 0.5);  // of what it swings through, without any trend over 10 s
}

// A joint slows as the equation of motion with its damping says, however stiff that is.
TEST(PhysicsDynamics, DampsAndRubsInJoints) {
  SceneSpec spec;
  addHinged(spec, "wheel", 1, 0.01).damping = 0.05;
  const auto speedAfter = [&](double h, double seconds) {
    const Model model = compile(spec);
    PhysicsWorld world(model);
    world.setState({model.initialPositions(), Eigen::VectorXd::Constant(1, 3), 0});
    for (int i = 0; i < static_cast<int>(std::lround(seconds / h)); ++i) world.step(h);
    return world.state().v[0];
  };
  EXPECT_NEAR(speedAfter(1e-3, 0.2), 3 * std::exp(-0.05 * 0.2 / 0.01), 0.01);
  spec.joints[0].damping = 1000;
  EXPECT_NEAR(speedAfter(1e-3, 0.01), 0, 1e-6);
  spec.joints[0].damping = 0;
  spec.joints[0].friction = 0.1;
  EXPECT_NEAR(speedAfter(1e-3, 0.2), 3 - 0.1 / 0.01 * 0.2, 1e-9);
  EXPECT_NEAR(speedAfter(1e-3, 0.4), 0, 1e-12);
}

// A body off the middle of its free joint, and one that hangs on it.
Model dampedPair(double damping, bool isAlone) {
  Rng rng(5);
  SceneSpec spec;
  addLoose(spec, "first", 1, boxShape(0.2, 0.3, 0.4), {});
  if (!isAlone) addHinged(spec, "second", 0.5, 0.02).parent = "first";
  spec.joints[0].damping = damping;
  spec.joints[0].X_PF = randomPose(rng);
  spec.joints[0].X_MC = {expSO3(rng.normalVector(3)), {0.05, -0.1, 0.02}};
  return compile(spec);
}

TEST(PhysicsDynamics, DampsFreeJointsLikeRungeKutta) {
  Rng rng(6);
  for (const bool isAlone : {true, false}) {
    const Model model = dampedPair(2, isAlone);
    const State start = randomState(rng, model);
    const auto error = [&](double h) {
      PhysicsWorld world(model);
      world.setState(start);
      Stepper stepper(model, {.jointForces = {.friction = true}});
      State ours = start;
      for (int i = 0; i < static_cast<int>(std::lround(0.2 / h)); ++i) {
        world.step(h);
        stepper.step(ours, Eigen::VectorXd::Zero(model.nv()), h);
      }
      return (world.state().v - ours.v).norm();
    };
    const double coarse = error(1e-3), fine = error(5e-4);
    EXPECT_LT(coarse, 0.05) << isAlone;
    EXPECT_NEAR(coarse / fine, 2, 0.3) << isAlone;
  }
}

// In honey everything falls at m g / damping in the end, however stiff that is.
TEST(PhysicsDynamics, DampsFreeJointsHoweverStiff) {
  Rng rng(7);
  for (const double damping : {1e3, 1e5, 1e8}) {
    for (const bool isAlone : {true, false}) {
      const Model model = dampedPair(damping, isAlone);
      PhysicsWorld world(model);
      State start = randomState(rng, model);
      if (!isAlone) start.v[6] = 0;
      world.setState(start);
      for (int i = 0; i < 100; ++i) world.step(1e-3);
      EXPECT_LT(world.state().v.head<6>().norm(), 10 * model.mass() * 9.81 / damping) << damping << isAlone;
    }
    SceneSpec spec;
    addLoose(spec, "ball", 2, ballShape(0.1), {});
    spec.joints[0].damping = damping;
    PhysicsWorld world(compile(spec));
    for (int i = 0; i < 100; ++i) world.step(1e-3);
    EXPECT_NEAR(world.state().v[2], -2 * 9.81 / damping, 1e-9 * 2 * 9.81 / damping);
  }
}

}  // namespace rex::dynamics_test
