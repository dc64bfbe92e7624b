// The hand of the robots closes on an object, in a simulation that knows nothing of grasps; what its contacts
// promise is what the simulation then shows.
#include <gtest/gtest.h>

#include "grasping/closure.h"
#include "grasping/equilibrium.h"
#include "grasping/quality.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "scene/scene_file.h"
#include "support/paths.h"

namespace rex {
namespace {

using Eigen::Vector3d;

constexpr double kMass = 0.1;      // kg
constexpr double kStrength = 0.1;  // N m of the last joint of a finger; more of those before

// The hand on the world, its fingers along z, and an object before its palm, where the fingers do not push it
// out before they are around it: a ball higher than a box.
Model handAnd(const Shape& object) {
  SceneSpec spec = readScene(sourcePath("data/robots/hand/hand.urdf")).spec;
  for (JointSpec& joint : spec.joints) {  // the simulation has no joints that mimic others
    joint.mimic.clear();
    joint.mimicRatio = 1;
  }
  const double fromPalm = 0.017 + halfBounds(object).x();  // a millimetre of air
  addLoose(spec, "object", kMass, object,
           translation(fromPalm, 0, object.type == ShapeType::kSphere ? 0.09 : 0.08));
  return compile(spec);
}

// Bends all fingers until something stops them.
std::vector<Motor> closing(const Model& model) {
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  const auto holds = [](const std::string& name, const char* part) {
    return name.find(part) != std::string::npos;
  };
  for (const Joint& joint : model.joints()) {
    if (joint.nv != 1) continue;
    Motor& motor = motors[static_cast<std::size_t>(joint.vIndex)];
    motor = {.kind = Motor::Kind::kPosition, .target = 0, .maxForce = 1};
    for (const auto& [part, share] : {std::pair{"knuckle", 3}, {"middle_bend", 2}, {"distal_bend", 1}})
      if (holds(joint.name, part))
        motor = {.kind = Motor::Kind::kVelocity, .target = 1, .maxForce = share * kStrength};
  }
  return motors;
}

PhysicsWorld worldOf(const Model& model, const State& state, const Vector3d& gravity_W) {
  PhysicsWorld world(model, {.gravity_W = gravity_W});
  world.setState(state);
  world.setMotors(closing(model));
  return world;
}

Pose objectPose(const Model& model, const State& state) {
  return forwardKinematics(model, state.q)[model.body("object")];
}

// Where the hand presses on the object, in the object's frame.
std::vector<Contact> contactsOf(const Model& model, const PhysicsWorld& world) {
  const BodyId object = model.body("object");
  const Pose X_OW = objectPose(model, world.state()).inverse();
  const auto bodyOf = [&](int shape) { return model.shapes()[static_cast<std::size_t>(shape)].body; };
  std::vector<Contact> contacts;
  for (const PhysicsContact& touch : world.contacts()) {
    const bool isA = bodyOf(touch.shapeA) == object;
    if (touch.impulse <= 0 || isA == (bodyOf(touch.shapeB) == object)) continue;
    const Vector3d inward_W = isA ? touch.normal_W : Vector3d(-touch.normal_W);
    contacts.push_back({X_OW * (isA ? touch.p_WA : touch.p_WB), (X_OW.R * inward_W).normalized(),
                        PhysicsOptions{}.friction});
  }
  return contacts;
}

const Vector3d kPulls[] = {{0, 0, -9.81}, {9.81, 0, 0}, {0, 9.81, 0}, {0, -9.81, 0}, {0, 0, 9.81}};

class Hand : public testing::TestWithParam<Shape> {};

TEST_P(Hand, ClosesToAGraspThatHoldsWhatItPromises) {
  const Model model = handAnd(GetParam());
  PhysicsWorld world = worldOf(model, initialState(model), Vector3d::Zero());
  EXPECT_TRUE(contactsOf(model, world).empty());
  world.step(3);
  const std::vector<Contact> contacts = contactsOf(model, world);
  const WrenchReference reference{.length = halfBounds(GetParam()).maxCoeff()};
  const std::vector<WrenchCone> cones = wrenchCones(contacts, reference);
  EXPECT_GE(contacts.size(), 4u);
  const ConeClosure verdict = forceClosure(cones);
  ASSERT_EQ(verdict.closure.status, ClosureStatus::kClosed) << verdict.closure.message;
  EXPECT_GT(graspQuality(primitiveWrenches(cones).wrenches).epsilon, 0.05);

  const Pose X_WO = objectPose(model, world.state());
  for (const Vector3d& gravity_W : kPulls) {
    const Eigen::VectorXd weight = weightWrench(kMass, {0, 0, 0}, X_WO.R.transpose() * gravity_W, reference);
    // The last joint of a finger presses with more at the end of its link, which is 22 mm long.
    EXPECT_EQ(equilibrium(cones, weight, 4).status, EquilibriumStatus::kHeld);
    PhysicsWorld heavy = worldOf(model, world.state(), gravity_W);
    heavy.step(1);
    EXPECT_LT((objectPose(model, heavy.state()).p - X_WO.p).norm(), 0.01) << gravity_W.transpose();
  }
}

TEST_P(Hand, HoldsNothingWhileItIsOpen) {
  const Model model = handAnd(GetParam());
  PhysicsWorld world = worldOf(model, initialState(model), {9.81, 0, 0});
  const std::vector<WrenchCone> cones = wrenchCones(contactsOf(model, world));
  EXPECT_EQ(forceClosure(cones).closure.status, ClosureStatus::kOpen);
  const Equilibrium lost = equilibrium(cones, weightWrench(kMass, {0, 0, 0}, {9.81, 0, 0}));
  ASSERT_EQ(lost.status, EquilibriumStatus::kNotHeld);
  EXPECT_NEAR(lost.direction[0], 1, 1e-12);
  world.step(0.5);
  EXPECT_GT(objectPose(model, world.state()).p.x(), 0.5);  // away from the palm
}

INSTANTIATE_TEST_SUITE_P(Objects, Hand, testing::Values(ballShape(0.03), boxShape(0.05, 0.05, 0.05)),
                         [](const auto& object) { return std::string(toString(object.param.type)); });

// Without friction a ball turns in any grasp, however many fingers touch it.
TEST(HandOnABall, HasNoFormClosure) {
  const Model model = handAnd(ballShape(0.03));
  PhysicsWorld world = worldOf(model, initialState(model), Vector3d::Zero());
  world.step(3);
  const Closure form = formClosure(wrenchCones(contactsOf(model, world)));
  ASSERT_EQ(form.status, ClosureStatus::kOpen);
  ASSERT_EQ(form.rank, 3) << form.message;
  EXPECT_LT(form.direction.head<3>().norm(),
            1e-4);  // it turns; the normals meet micrometres beside its centre
}

}  // namespace
}  // namespace rex
