// Joints that mimic others, and screws, which are turns that a rise follows: Bullet's coordinates against our
// dynamics, which have one for all of them.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "formats/scene_file.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/expect_error.h"
#include "support/paths.h"
#include "support/random_scene.h"

namespace rex::coupling_test {

const PhysicsOptions kBare{.jointLimits = false, .jointFriction = false};

void run(PhysicsWorld& world, double seconds) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / 1e-3)); ++i) world.step(1e-3);
}

// A body with a box on a slider or hinge.
JointSpec& addPart(SceneSpec& spec, const std::string& name, const std::string& parent, JointType type,
                   const Eigen::Vector3d& axis, double mass, const Eigen::Vector3d& size, const Pose& X_BS) {
  BodySpec body;
  body.name = name;
  body.mass = mass;
  body.p_BBcm = X_BS.p;
  body.inertia = Eigen::Matrix3d(
      (mass / 12 * (size.cwiseAbs2().sum() - size.cwiseAbs2().array()).matrix()).asDiagonal());
  ShapeSpec shape;
  shape.name = name;
  shape.X_BS = X_BS;
  shape.shape = boxShape(size.x(), size.y(), size.z());
  shape.contact = true;
  body.shapes.push_back(shape);
  spec.bodies.push_back(body);
  JointSpec joint;
  joint.name = name;
  joint.parent = parent;
  joint.child = name;
  joint.type = type;
  joint.axis = axis;
  return spec.joints.emplace_back(joint);
}

void follow(JointSpec& joint, const std::string& leader, double ratio, double offset) {
  joint.mimic = leader;
  joint.mimicRatio = ratio;
  joint.mimicOffset = offset;
}

// A hand on a hinge, with two fingers that close together and tips that bend as they do. The second finger
// is ten times as heavy as the one that leads.
SceneSpec gripper() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  SceneSpec spec;
  spec.name = "gripper";
  addPart(spec, "hand", "world", JointType::kHinge, y, 0.7, {0.2, 0.06, 0.1}, translation(0, 0, -0.1));
  JointSpec& left = addPart(spec, "left", "hand", JointType::kSlider, x, 0.02, {0.02, 0.02, 0.1},
                            translation(0.04, 0, -0.2));
  left.q0 = Eigen::VectorXd::Constant(1, 0.01);
  follow(addPart(spec, "right", "hand", JointType::kSlider, -x, 0.2, {0.02, 0.02, 0.1},
                 translation(-0.04, 0, -0.2)),
         "left", 1, 0);
  JointSpec& tip = addPart(spec, "left tip", "left", JointType::kHinge, y, 0.01, {0.01, 0.02, 0.04},
                           translation(0, 0, -0.02));
  tip.X_PF = translation(0.04, 0, -0.26);
  follow(tip, "left", -7, 0.1);
  JointSpec& other = addPart(spec, "right tip", "right", JointType::kHinge, y, 0.03, {0.01, 0.02, 0.04},
                             translation(0, 0, -0.02));
  other.X_PF = translation(-0.04, 0, -0.26);
  follow(other, "left", 7, -0.1);
  return spec;
}

// How far all boxes are from where forward kinematics has them, by rays onto the middles of two faces.
double misplacement(const Model& model, const PhysicsWorld& world) {
  const BodyPoses poses = forwardKinematics(model, world.state().q);
  double worst = 0;
  for (std::size_t k = 0; k < model.shapes().size(); ++k) {
    const ModelShape& shape = model.shapes()[k];
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    for (int axis = 0; axis < 2; ++axis) {
      const double half = shape.shape.extent[axis] / 2;
      const auto hit = world.rayCast(X_WS * (1.5 * half * Eigen::Vector3d::Unit(axis)), X_WS.p);
      if (!hit || hit->shape != static_cast<int>(k)) return INFINITY;
      worst = std::max(worst, (hit->p_WQ - X_WS * (half * Eigen::Vector3d::Unit(axis))).norm());
    }
  }
  return worst;
}

// The largest difference of accelerations, as a share of the largest acceleration.
double accelerationError(const Model& model, const State& state, const Eigen::VectorXd& u) {
  constexpr double kStep = 1e-7;
  const Eigen::VectorXd bullet = (stepped(model, state, u, kStep).v - state.v) / kStep;
  const Eigen::VectorXd ours = forwardDynamicsByMassMatrix(model, state.q, state.v, u);
  return (bullet - ours).lpNorm<Eigen::Infinity>() / ours.lpNorm<Eigen::Infinity>();
}

// Screws, and joints that follow others at random ratios, up and down the tree and between two trees.
Model randomFollowers(Rng& rng, int bodies) {
  SceneSpec spec = randomScene(rng, bodies);
  JointSpec base;
  base.name = "base";
  base.parent = "world";
  base.child = "b0";
  base.type = rng.index(2) == 0 ? JointType::kFree : JointType::kHinge;
  spec.joints.push_back(base);
  addHinged(spec, "apart", 1, 0.2);
  std::vector<std::string> leaders{"apart"};
  for (JointSpec& joint : spec.joints) {
    if (positionCount(joint.type) != 1 || joint.name == "apart") continue;
    if (rng.index(2) == 0)
      leaders.push_back(joint.name);
    else
      follow(joint, leaders[static_cast<std::size_t>(rng.index(static_cast<int>(leaders.size())))],
             rng.normal(), rng.normal());
  }
  return compile(spec);
}

TEST(PhysicsCouplings, AccelerateRandomTreesAsOurDynamics) {
  Rng rng(11);
  double worst = 0;
  int followers = 0;
  for (int i = 0; i < 100; ++i) {
    const Model model = randomFollowers(rng, 3 + i % 13);
    for (const Joint& joint : model.joints()) followers += joint.mimics ? 1 : 0;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.nv());
    const State state{integrate(model, randomPositions(rng, model.nq()), zero), rng.normalVector(model.nv()),
                      0};
    worst = std::max(worst, accelerationError(model, state, rng.normalVector(model.nv())));
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_GT(followers, 100);
  EXPECT_LT(worst, 1e-6);
}

TEST(PhysicsCouplings, GiveBackTheState) {
  Rng rng(12);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomFollowers(rng, 14);
    PhysicsWorld world(model, kBare);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.nv());
    const State state{integrate(model, randomPositions(rng, model.nq()), zero), rng.normalVector(model.nv()),
                      0};
    world.setState(state);
    const State back = world.state();
    EXPECT_LT(difference(model, state.q, back.q).norm(), 1e-12);
    EXPECT_LT((state.v - back.v).norm(), 1e-12);
  }
}

// Ten seconds of swinging, with the fingers on springs that a force stands for. Bullet moves v on before q,
// as our semi-implicit Euler does.
TEST(PhysicsCouplings, AGripperSwingsForTenSeconds) {
  const Model model = compile(gripper());
  PhysicsWorld world(model, kBare);
  Stepper stepper(model, {.integrator = Integrator::kSemiImplicitEuler});
  State ours = initialState(model);
  ours.q[0] = 1.2;
  world.setState(ours);
  constexpr double kSpring = 600, kRest = 0.012;
  const auto push = [&](const State& now) { return -kSpring * (now.q[1] - kRest); };
  const auto total = [&](const State& now) {
    return energy(model, now.q, now.v).total() + kSpring / 2 * std::pow(now.q[1] - kRest, 2);
  };
  const double start = total(ours), range = start - total(initialState(model));
  double drift = 0, error = 0, way = 0, apart = 0;
  for (int i = 0; i < 10000; ++i) {
    world.setMotors(std::vector<Motor>{{}, {.target = push(world.state())}});
    world.step(1e-3);
    stepper.step(ours, Eigen::Vector2d(0, push(ours)), 1e-3);
    const State now = world.state();
    apart = std::max(apart, (now.q - ours.q).norm());
    drift = std::max(drift, std::abs(total(now) - start));
    way = std::max(way, std::abs(now.q[1] - 0.01));
    EXPECT_TRUE(world.events().empty());
    if (i % 100 == 0) error = std::max(error, misplacement(model, world));
  }
  RecordProperty("drift", fmt::format("{:g} of {:g} J", drift, range));
  RecordProperty("error", fmt::format("{:g}", error));
  RecordProperty("apart", fmt::format("{:g}", apart));
  EXPECT_GT(way, 0.003);
  EXPECT_LT(drift, 0.01 * range);
  EXPECT_LT(error, 1e-9);
  EXPECT_LT(apart, 1e-6);
}

TEST(PhysicsCouplings, SwingLikeRungeKutta) {
  const Model model = compile(gripper());
  PhysicsWorld world(model, kBare);
  State state = initialState(model);
  state.q[0] = 1.2;
  world.setState(state);
  Stepper stepper(model);
  const Eigen::Vector2d u(0, 0.02);
  world.setMotors(std::vector<Motor>{{.target = u[0]}, {.target = u[1]}});
  for (int i = 0; i < 2000; ++i) {
    world.step(1e-4);
    stepper.step(state, u, 1e-4);
  }
  EXPECT_GT((state.q - initialState(model).q).norm(), 0.1);
  EXPECT_LT((world.state().q - state.q).norm(), 1e-3);
}

// The fingers squeeze a bar that stands still; the work of the force is shared by both.
TEST(PhysicsCouplings, AForceOnALeaderIsSharedByWhatFollows) {
  SceneSpec spec;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  ShapeSpec bar;
  bar.shape = boxShape(0.04, 0.1, 0.1);
  bar.contact = true;
  spec.bodies.push_back({.name = "bar", .X_WB = {}, .shapes = {bar}});
  JointSpec& left = addPart(spec, "left", "world", JointType::kSlider, x, 0.02, {0.02, 0.05, 0.05}, {});
  left.X_PF = translation(0.04, 0, 0);
  JointSpec& right = addPart(spec, "right", "world", JointType::kSlider, x, 0.5, {0.02, 0.05, 0.05}, {});
  right.X_PF = translation(-0.04, 0, 0);
  follow(right, "left", -1, 0);
  PhysicsWorld world(compile(spec));
  world.setMotors(std::vector<Motor>{{.target = -10}});
  run(world, 1);
  EXPECT_NEAR(world.state().q[0], -0.01, 1e-3);
  double onBar[2] = {0, 0};
  for (const PhysicsContact& contact : world.contacts()) onBar[contact.shapeB - 1] += contact.impulse;
  EXPECT_NEAR(onBar[0] + onBar[1], 10e-3, 1e-5);
  EXPECT_GT(std::min(onBar[0], onBar[1]), 0);
}

TEST(PhysicsCouplings, MotorsMoveWhatIsHeavierThanTheirLink) {
  SceneSpec spec = gripper();
  spec.joints[1].lower = Eigen::VectorXd::Constant(1, -0.02);
  spec.joints[1].upper = Eigen::VectorXd::Constant(1, 0.02);
  const Model model = compile(spec);
  PhysicsWorld world(model, {.gravity_W = Eigen::Vector3d::Zero()});
  world.setMotors(std::vector<Motor>{{Motor::Kind::kPosition, 0.3, 50}, {Motor::Kind::kPosition, -0.01, 50}});
  run(world, 2);
  EXPECT_LT((world.state().q - Eigen::Vector2d(0.3, -0.01)).norm(), 1e-4);
  EXPECT_LT(misplacement(model, world), 1e-9);
  world.setMotors(std::vector<Motor>{{Motor::Kind::kPosition, 0.3, 50}, {.target = 50}});
  run(world, 1);
  EXPECT_NEAR(world.state().q[1], 0.02, 1e-3);
  EXPECT_LT(misplacement(model, world), 1e-9);
}

// Two wheels far apart, geared: q2 = -3 q1 + 0.5. Effective inertia 0.5 + 9 * 0.1.
TEST(PhysicsCouplings, GearTreesThatShareNothing) {
  SceneSpec spec;
  follow(addHinged(spec, "first", 1, 0.1), "second", -3, 0.5);
  addHinged(spec, "second", 1, 0.5);
  const Model model = compile(spec);
  PhysicsWorld world(model);
  world.setMotors(std::vector<Motor>{{.target = 2.8}});
  run(world, 0.5);
  EXPECT_NEAR(world.state().v[0], 2.8 / 1.4 * 0.5, 1e-9);
  run(world, 9.5);
  EXPECT_NEAR(world.state().v[0], 20, 1e-8);
}

TEST(PhysicsCouplings, DampAndRubWithTheLeverOfTheRatio) {
  SceneSpec spec;
  addHinged(spec, "leader", 1, 0.5);
  JointSpec& follower = addHinged(spec, "follower", 1, 0.1);
  follow(follower, "leader", -3, 0);
  follower.damping = 0.2;
  const Model model = compile(spec);
  PhysicsWorld world(model);
  State state = initialState(model);
  state.v[0] = 1;
  world.setState(state);
  for (int i = 0; i < 5000; ++i) world.step(1e-4);
  EXPECT_NEAR(world.state().v[0], std::exp(-9 * 0.2 / 1.4 * 0.5), 1e-3);
}

TEST(PhysicsCouplings, ANutSinksOnItsScrew) {
  SceneSpec spec;
  JointSpec& nut = addHinged(spec, "nut", 2, 0.01);
  nut.type = JointType::kScrew;
  nut.axis = Eigen::Vector3d::UnitZ();
  nut.pitch = -0.3;
  PhysicsWorld world(compile(spec));
  run(world, 0.5);
  const double k = 0.3 / (2 * std::numbers::pi);
  EXPECT_NEAR(world.state().v[0], 2 * 9.81 * k / (0.01 + 2 * k * k) * 0.5, 1e-6);
}

TEST(PhysicsCouplings, RefuseQuaternionsAndWhatHasNoMass) {
  SceneSpec spec;
  addHinged(spec, "leader", 1, 0.1).type = JointType::kBall;
  JointSpec& ball = addHinged(spec, "follower", 1, 0.1);
  ball.type = JointType::kBall;
  ball.mimic = "leader";
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)), "joint 'follower': found a ball joint that mimics another");
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)),
                   "wanted mimics of joints without quaternions; without contact");

  spec.joints[0].type = spec.joints[1].type = JointType::kHinge;
  spec.bodies[1].mass = 0;
  spec.bodies[1].inertia = Eigen::Matrix3d::Zero();
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)),
                   "joint 'follower' moves no mass: wanted some: give body 'follower' a mass and an inertia");
  // What hangs on it turns about the same axis, and leaves it nothing to move.
  addHinged(spec, "spinner", 1, 0.1).parent = "follower";
  EXPECT_REX_ERROR(PhysicsWorld(compile(spec)), "joint 'follower' moves no mass: wanted some: give body");
}

}  // namespace rex::coupling_test
