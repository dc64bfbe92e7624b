// What the world says, holds and refuses.
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::world_test {

void run(PhysicsWorld& world, double seconds, double h = 1e-3) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / h)); ++i) world.step(h);
}

// Some boxes and balls that fall on each other.
Model heap() {
  SceneSpec spec;
  addGround(spec);
  for (int i = 0; i < 6; ++i) {
    const Pose X_WB = translation(0.03 * i, 0.02 * i * i, 0.2 + 0.3 * i) * rotation(0.3 * i, {1, 2, 3});
    addLoose(spec, "thing" + std::to_string(i), 1 + i, i % 2 == 0 ? boxShape(0.2, 0.3, 0.1) : ballShape(0.1),
             X_WB);
  }
  return compile(spec);
}

std::vector<double> numbersOf(const PhysicsWorld& world) {
  std::vector<double> all;
  const auto add = [&](const auto& vector) { all.insert(all.end(), vector.begin(), vector.end()); };
  const State state = world.state();
  add(state.q);
  add(state.v);
  for (const PhysicsContact& contact : world.contacts()) {
    all.insert(all.end(), {1.0 * contact.shapeA, 1.0 * contact.shapeB, contact.distance, contact.impulse});
    add(contact.p_WA);
    add(contact.p_WB);
    add(contact.normal_W);
  }
  return all;
}

// FNV-1a over the bytes.
std::uint64_t hashOf(const std::vector<double>& numbers) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const double number : numbers) {
    auto bits = std::bit_cast<std::uint64_t>(number);
    for (int i = 0; i < 8; ++i, bits >>= 8) hash = (hash ^ (bits & 0xff)) * 0x100000001b3u;
  }
  return hash;
}

TEST(PhysicsWorld, RepeatsItselfToTheBit) {
  const Model model = heap();
  PhysicsWorld first(model), second(model);
  run(first, 2);
  run(second, 2);
  const std::vector<double> numbers = numbersOf(first);
  EXPECT_FALSE(first.contacts().empty());
  EXPECT_EQ(numbers, numbersOf(second));
  first.setState(initialState(model));
  EXPECT_TRUE(first.contacts().empty());
  run(first, 2);
  EXPECT_EQ(numbers, numbersOf(first));
  PhysicsWorld moved = std::move(first);
  run(moved, 0.1);
  run(second, 0.1);
  EXPECT_EQ(numbersOf(moved), numbersOf(second));
}

// Freely, driven, held by friction and stopped by limits: our own dynamics remember nothing, either.
TEST(PhysicsWorld, AnArmRepeatsItselfToTheBit) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  for (const bool isFree : {true, false}) {
    const PhysicsOptions options{.jointLimits = !isFree, .jointFriction = !isFree};
    PhysicsWorld first(model, options), second(model, options);
    std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
    if (!isFree) motors[1] = {Motor::Kind::kVelocity, 1, 50};
    first.setMotors(motors);
    second.setMotors(motors);
    run(first, 1);
    run(second, 1);
    const std::vector<double> numbers = numbersOf(first);
    EXPECT_EQ(numbers, numbersOf(second));
    first.setState(initialState(model));
    run(first, 1);
    EXPECT_EQ(numbers, numbersOf(first));
    PhysicsWorld moved = std::move(first);
    run(moved, 0.1);
    run(second, 0.1);
    EXPECT_EQ(numbersOf(moved), numbersOf(second));
  }
}

TEST(PhysicsWorld, AnArmThatBlowsUpGoesBackToWhereItWas) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  PhysicsWorld world(model);
  run(world, 0.1);
  const State before = world.state();
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  motors[0].target = 1e12;
  world.setMotors(motors);
  EXPECT_REX_ERROR(world.step(1e-3), "found a motion that grows without bounds");
  EXPECT_EQ(world.state().q, before.q);
  EXPECT_EQ(world.state().v, before.v);
  EXPECT_EQ(world.state().time, before.time);
  world.setMotors(std::vector<Motor>(motors.size()));
  run(world, 0.1);
  EXPECT_NEAR(world.state().time, before.time + 0.1, 1e-9);
}

TEST(PhysicsWorld, HasAGoldenHash) {
  PhysicsWorld world(heap());
  run(world, 1);
#ifdef __aarch64__  // Debian's Bullet has the same bytes on every machine, but is compiled for each
                    // processor.
  EXPECT_EQ(hashOf(numbersOf(world)), 14008121807504692321u);
#else
  EXPECT_EQ(hashOf(numbersOf(world)), 1661394280440905751u);
#endif
}

TEST(PhysicsWorld, TellsWhatTouches) {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "box", 2, boxShape(0.2, 0.2, 0.2), translation(0, 0, 0.1));
  addLoose(spec, "ball", 1, ballShape(0.1), translation(0, 0, 0.3));
  PhysicsWorld world(compile(spec));
  run(world, 0.5);
  const std::vector<PhysicsContact> contacts = world.contacts();
  ASSERT_EQ(contacts.size(), 5u);
  double onGround = 0;
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(contacts[i].shapeA, 0);
    EXPECT_EQ(contacts[i].shapeB, 1);
    EXPECT_LT((contacts[i].normal_W - Eigen::Vector3d(0, 0, -1)).norm(), 1e-3);
    EXPECT_LT((contacts[i].p_WA.cwiseAbs() - Eigen::Vector3d(0.1, 0.1, 0)).norm(), 1e-3);
    EXPECT_LT((contacts[i].p_WA - contacts[i].p_WB).norm(), 1e-3);
    EXPECT_NEAR(contacts[i].distance, 0, 1e-4);
    onGround += contacts[i].impulse;
  }
  EXPECT_EQ(contacts[4].shapeA, 1);
  EXPECT_EQ(contacts[4].shapeB, 2);
  EXPECT_NEAR(onGround, 3 * 9.81 * 1e-3, 1e-4);
  EXPECT_NEAR(contacts[4].impulse, 1 * 9.81 * 1e-3, 1e-4);
}

TEST(PhysicsWorld, RaysHitWhatTheyMeetFirst) {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "ball", 1, ballShape(0.5), translation(3, 0, 1));
  Shape capsule = ballShape(0.25);
  capsule.type = ShapeType::kCapsule;
  capsule.extent.z() = 1;
  addLoose(spec, "capsule", 1, capsule, translation(6, 0, 1));
  addLoose(spec, "box", 1, boxShape(1, 2, 2), translation(9, 0, 1) * rotation(0.1, Eigen::Vector3d::UnitX()));
  const PhysicsWorld world(compile(spec));
  const auto hit = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return world.rayCast(from, to).value();
  };
  const Eigen::Vector3d back(-1, 0, 0);
  const RayHit ball = hit({0, 0, 1}, {20, 0, 1}), capsuleHit = hit({4, 0, 1.3}, {20, 0, 1.3}),
               box = hit({7, 0, 1}, {20, 0, 1}), ground = hit({1, 1, 5}, {1, 1, -5});
  EXPECT_EQ(ball.shape, 1);
  EXPECT_NEAR(ball.distance, 2.5, 1e-9);
  EXPECT_LT((ball.p_WQ - Eigen::Vector3d(2.5, 0, 1)).norm(), 1e-9);
  EXPECT_LT((ball.normal_W - back).norm(), 1e-9);
  EXPECT_EQ(capsuleHit.shape, 2);
  EXPECT_NEAR(capsuleHit.distance, 1.75, 1e-9);
  EXPECT_EQ(box.shape, 3);
  EXPECT_NEAR(box.distance, 1.5, 1e-9);
  EXPECT_LT((box.normal_W - back).norm(), 1e-9);
  EXPECT_EQ(ground.shape, 0);
  EXPECT_NEAR(ground.distance, 5, 1e-9);
  EXPECT_FALSE(world.rayCast({0, 0, 5}, {20, 0, 5}));
  EXPECT_REX_ERROR(world.rayCast({0, 0, std::nan("")}, {1, 0, 0}), "start of the ray: number 2: found nan");
  EXPECT_REX_ERROR(world.rayCast({0, 0, 0}, {1, 0, std::nan("")}), "end of the ray: number 2: found nan");
}

TEST(PhysicsWorld, MotorsReachTheirTargets) {
  const Model model = compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec);
  PhysicsWorld world(model);
  std::vector<Motor> motors;
  Eigen::VectorXd goal(model.nv());
  for (int i = 0; i < model.nv(); ++i) {
    goal[i] = 0.5 * (model.lowerLimits()[i] + model.upperLimits()[i]) + 0.2;
    motors.push_back({.kind = Motor::Kind::kPosition, .target = goal[i], .maxForce = 200});
  }
  world.setMotors(motors);
  run(world, 2);
  EXPECT_LT((world.state().q - goal).norm(), 1e-3);
  EXPECT_LT(world.state().v.norm(), 1e-3);
}

TEST(PhysicsWorld, MotorsAreNoStrongerThanTheyMayBe) {
  SceneSpec spec;
  addHinged(spec, "wheel", 1, 0.5);
  const Model model = compile(spec);
  PhysicsWorld world(model);
  world.setMotors(std::vector<Motor>{{Motor::Kind::kVelocity, 4, 2}});
  run(world, 0.5);
  EXPECT_NEAR(world.state().v[0], 2 / 0.5 * 0.5, 1e-9);
  run(world, 1);
  EXPECT_NEAR(world.state().v[0], 4, 1e-9);
  world.setState(initialState(model));
  world.setMotors(std::vector<Motor>{{.target = 3}});
  run(world, 0.5);
  EXPECT_NEAR(world.state().v[0], 3 / 0.5 * 0.5, 1e-9);
}

TEST(PhysicsWorld, StopsAtJointLimits) {
  SceneSpec spec;
  JointSpec& joint = addHinged(spec, "arm", 1, 0.01);
  joint.X_MC = translation(0.3, 0, 0);
  joint.lower = Eigen::VectorXd::Constant(1, -0.4);
  joint.upper = Eigen::VectorXd::Constant(1, 0.6);
  const Model model = compile(spec);
  PhysicsWorld free(model, {.jointLimits = false}), world(model);
  run(free, 1);
  EXPECT_GT(free.state().q[0], 1);
  double farthest = 0;
  for (int i = 0; i < 1000; ++i) {
    world.step(1e-3);
    farthest = std::max(farthest, world.state().q[0]);
  }
  EXPECT_NEAR(world.state().q[0], 0.6, 1e-6);
  EXPECT_LT(farthest, 0.6 + 1e-3);
  world.setMotors(std::vector<Motor>{{.target = -50}});
  run(world, 1);
  EXPECT_NEAR(world.state().q[0], -0.4, 1e-4);
}

TEST(PhysicsWorld, ComesBackSlowlyFromBeyondALimit) {
  SceneSpec spec;
  JointSpec& joint = addHinged(spec, "arm", 1, 0.01);
  joint.lower = Eigen::VectorXd::Constant(1, -0.4);
  joint.upper = Eigen::VectorXd::Constant(1, 0.6);
  const Model model = compile(spec);
  for (const double beyond : {-0.5, -0.07, 0.07, 0.5}) {
    PhysicsWorld world(model);
    State state = initialState(model);
    state.q[0] = beyond > 0 ? 0.6 + beyond : -0.4 + beyond;
    world.setState(state);
    double fastest = 0;
    for (int i = 0; i < 700; ++i) {
      world.step(1e-3);
      fastest = std::max(fastest, std::abs(world.state().v[0]));
    }
    EXPECT_LT(fastest, 1 + 1e-9) << beyond;
    EXPECT_GT(fastest, 0.9) << beyond;
    EXPECT_GE(world.state().q[0], -0.4) << beyond;
    EXPECT_LE(world.state().q[0], 0.6) << beyond;
  }
}

// Forces on free joints act at the joint's moved frame, as in forwardDynamics.
TEST(PhysicsWorld, ADogStandsOnItsMotors) {
  SceneSpec spec = readScene(sourcePath("data/robots/quadruped/quadruped.urdf")).spec;
  addGround(spec);
  JointSpec root;
  root.name = "root";
  root.parent = "world";
  root.child = "torso";
  root.type = JointType::kFree;
  spec.joints.push_back(root);
  const Model model = compile(spec);
  State state = initialState(model);
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  for (const Joint& joint : model.joints()) {
    const bool isPitch = joint.name.ends_with("hip_pitch"), isKnee = joint.name.ends_with("knee");
    if (joint.type != JointType::kHinge) continue;
    state.q[joint.qIndex] = isPitch ? 0.75 : isKnee ? -1.5 : 0;
    motors[static_cast<std::size_t>(joint.vIndex)] = {Motor::Kind::kPosition, state.q[joint.qIndex], 30};
  }
  state.q.segment<3>(model.joints().front().qIndex) = Eigen::Vector3d(0, 0, 0.5);
  PhysicsWorld world(model);
  world.setState(state);
  world.setMotors(motors);
  run(world, 2);
  const BodyPoses poses = forwardKinematics(model, world.state().q);
  const Pose torso = poses[model.body("torso")];
  EXPECT_GT(torso.p.z(), 0.25);
  EXPECT_LT(torso.p.z(), 0.45);
  EXPECT_GT(torso.R(2, 2), 0.999);
  EXPECT_LT(world.state().v.norm(), 1e-2);
  double impulse = 0;
  for (const PhysicsContact& contact : world.contacts()) impulse += contact.impulse;
  EXPECT_NEAR(impulse, model.mass() * 9.81 * 1e-3, 1e-3 * model.mass() * 9.81 * 1e-3);
  for (const char* foot : {"front_left_foot", "front_right_foot", "rear_left_foot", "rear_right_foot"})
    EXPECT_LT(poses[model.body(foot)].p.z(), 0.05) << foot;
}

TEST(PhysicsWorld, NeighboursDoNotCollide) {
  SceneSpec spec;
  addHinged(spec, "upper", 1, 0.01);
  addHinged(spec, "lower", 1, 0.01).parent = "upper";
  for (BodySpec& body : spec.bodies) {
    ShapeSpec& shape = body.shapes.emplace_back();
    shape.shape = ballShape(0.1);
    shape.contact = true;
  }
  PhysicsWorld world(compile(spec));
  run(world, 0.1);
  EXPECT_TRUE(world.contacts().empty());
}

TEST(PhysicsWorld, RefusesWrongNumbers) {
  const Model model = heap();
  EXPECT_REX_ERROR(PhysicsWorld(model, {.gravity_W = {0, 0, std::nan("")}}),
                   "physics: gravity: number 2: found nan");
  EXPECT_REX_ERROR(PhysicsWorld(model, {.friction = -1}),
                   "physics: friction: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(PhysicsWorld(model, {.restitution = 1.5}), "restitution: found 1.5, wanted a number from");
  EXPECT_REX_ERROR(PhysicsWorld(model, {.iterations = 0}), "iterations: found 0, wanted at least 1");
  PhysicsWorld world(model);
  const State state = world.state();
  for (const double h : {0.0, -1e-3, 9e-10, 1001.0, static_cast<double>(INFINITY)})
    EXPECT_REX_ERROR(world.step(h), "time step: found");
  EXPECT_REX_ERROR(world.step(std::nan("")), "time step: found nan, wanted 1e-09 to 1000 seconds");
  State wrong = state;
  wrong.q.conservativeResize(3);
  EXPECT_REX_ERROR(world.setState(wrong), "positions q: found a vector of size 3, wanted size 42");
  wrong = state;
  wrong.v.conservativeResize(3);
  EXPECT_REX_ERROR(world.setState(wrong), "velocities v: found a vector of size 3, wanted size 36");
  wrong = state;
  wrong.v[2] = INFINITY;
  EXPECT_REX_ERROR(world.setState(wrong), ": found inf, wanted a finite number");
  wrong = state;
  wrong.q[2] = std::nan("");
  EXPECT_REX_ERROR(world.setState(wrong), ": found nan, wanted a finite number");
  wrong = state;
  wrong.time = std::nan("");
  EXPECT_REX_ERROR(world.setState(wrong), "physics: time: found nan");
  wrong = state;
  wrong.q.tail<4>().setZero();
  EXPECT_REX_ERROR(world.setState(wrong), "physics: quaternion of joint 'thing5': found zero");
}

// As if the refused state had never been given.
TEST(PhysicsWorld, GoesOnAfterARefusedState) {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "box", 1, boxShape(0.2, 0.2, 0.2), translation(0, 0, 0.1));
  addHinged(spec, "arm", 1, 0.1).type = JointType::kBall;
  const Model model = compile(spec);
  for (const Joint& joint : model.joints()) {
    PhysicsWorld world(model), undisturbed(model);
    run(world, 0.1);
    run(undisturbed, 0.1);
    State wrong = world.state();
    wrong.q.segment<4>(joint.qIndex + joint.nq - 4).setZero();
    EXPECT_REX_ERROR(world.setState(wrong), "physics: quaternion of joint '" + joint.name + "': found");
    EXPECT_REX_ERROR(world.setState(wrong), "found zero, wanted four numbers that are not all zero");
    run(world, 0.1);
    run(undisturbed, 0.1);
    EXPECT_EQ(numbersOf(world), numbersOf(undisturbed));
  }
}

TEST(PhysicsWorld, TakesQuaternionsOfAnyLength) {
  SceneSpec spec;
  addHinged(spec, "arm", 1, 0.1).type = JointType::kBall;
  const Model model = compile(spec);
  PhysicsWorld world(model);
  State state = initialState(model);
  state.q = Eigen::Vector4d(3e-200, 0, 4e-200, 0);
  world.setState(state);
  EXPECT_LT((world.state().q - Eigen::Vector4d(0.6, 0, 0.8, 0)).norm(), 1e-15);
}

TEST(PhysicsWorld, RefusesWrongMotors) {
  PhysicsWorld world(heap());
  std::vector<Motor> motors(35);
  EXPECT_REX_ERROR(world.setMotors(motors), "motors: found a vector of size 35, wanted size 36");
  motors.resize(36);
  motors[7].target = std::nan("");
  EXPECT_REX_ERROR(world.setMotors(motors), "motor of joint 'thing1': target: found nan");
  motors[7] = {Motor::Kind::kVelocity, 1, 1};
  EXPECT_REX_ERROR(world.setMotors(motors), "motor of joint 'thing1': found a target for a free joint");
  motors[7].maxForce = -1;
  EXPECT_REX_ERROR(world.setMotors(motors),
                   "motor of joint 'thing1': maxForce: found -1, wanted a number, 0 or more, or infinity");
}

// A wheel of a hundredth of a milligram, a millimetre wide.
TEST(PhysicsWorld, MovesWhatIsTiny) {
  SceneSpec spec;
  addHinged(spec, "wheel", 1e-8, 1e-14);
  PhysicsWorld world(compile(spec));
  world.setMotors(std::vector<Motor>{{.target = 3e-14}});
  run(world, 0.5);
  EXPECT_NEAR(world.state().v[0], 1.5, 1e-9);
}

TEST(PhysicsWorld, RefusesWhatItCannotSimulate) {
  SceneSpec spec;
  addHinged(spec, "arm", 1, 0.1);
  addHinged(spec, "hand", 0, 0).parent = "arm";
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)),
                   "joint 'hand' moves no mass: wanted some: give body 'hand' a");
  std::swap(spec.bodies[0].mass, spec.bodies[1].mass);
  std::swap(spec.bodies[0].inertia, spec.bodies[1].inertia);
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)), "joint 'arm' moves no mass: wanted some: give body 'arm' a");
  spec.bodies[0].mass = 1;
  spec.bodies[0].inertia = 1e-15 / 2 * Eigen::Matrix3d::Identity();
  spec.bodies[1].inertia = 1e-15 / 4 * Eigen::Matrix3d::Identity();
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)), "joint 'arm': found too little mass or inertia to move");
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)), "wanted at least 1e-15 kg or kg m^2");
}

TEST(PhysicsWorld, LongStepsAreManyShortOnes) {
  const Model model = heap();
  PhysicsWorld world(model), inStrides(model);
  run(world, 0.5);
  inStrides.step(0.3);
  inStrides.step(0.2);
  EXPECT_LT((world.state().q - inStrides.state().q).norm(), 1e-9);
  EXPECT_NEAR(inStrides.state().time, 0.5, 1e-12);
}

TEST(PhysicsWorld, TurnsAsFarAsItSpins) {
  SceneSpec spec;
  addLoose(spec, "ball", 1, ballShape(0.1), {});
  const Model model = compile(spec);
  State state = initialState(model);
  state.v[5] = 100;
  PhysicsWorld world(model);
  world.setState(state);
  world.step(0.1);
  const Eigen::Matrix3d wanted = expSO3(Eigen::Vector3d(0, 0, 10));
  EXPECT_LT((rotationFromQuaternion(world.state().q.tail<4>()) - wanted).norm(), 1e-9);
}

TEST(PhysicsWorld, GoesBackToTheStartOfALongStep) {
  SceneSpec spec;
  addHinged(spec, "wheel", 1, 0.5);
  PhysicsWorld world(compile(spec), {.gravity_W = Eigen::Vector3d::Zero()});
  world.setMotors(std::vector<Motor>{{.target = 5e7}});  // beyond 1e6 rad/s after 10 ms
  EXPECT_REX_ERROR(world.step(0.1), "joint 'wheel' at 0.01 s");
  EXPECT_EQ(world.state().q[0], 0);
  EXPECT_EQ(world.state().v[0], 0);
  EXPECT_EQ(world.state().time, 0);
}

TEST(PhysicsWorld, ReportsABlowUpAndGoesBack) {
  SceneSpec spec;
  addHinged(spec, "wheel", 1, 0.5);
  addLoose(spec, "ball", 1, ballShape(0.1), {});
  const Model model = compile(spec);
  for (const int iv : {0, 1, 4}) {
    PhysicsWorld world(model, {.gravity_W = Eigen::Vector3d::Zero()});
    std::vector<Motor> motors(7);
    State state = initialState(model);
    state.v.setConstant(0.1);
    state.time = 3;
    world.setState(state);
    motors[static_cast<std::size_t>(iv)].target = 1e12;
    world.setMotors(motors);
    EXPECT_REX_ERROR(world.step(1e-3), iv == 0 ? "joint 'wheel' at 3.001 s" : "joint 'ball' at 3.001 s");
    EXPECT_REX_ERROR(world.step(1e-3), "found a motion that grows without bounds, wanted shorter steps");
    EXPECT_LT((world.state().v - state.v).norm(), 1e-12);
    EXPECT_LT((world.state().q - state.q).norm(), 1e-12);
    world.setMotors(std::vector<Motor>(7));
    world.step(1e-3);
    EXPECT_NEAR(world.state().time, 3.001, 1e-12);
  }
}

}  // namespace rex::world_test
