// The hand of the robots closes on an object, in a simulation that knows nothing of grasps; what its contacts
// promise is what the simulation then shows.
#include <gtest/gtest.h>

#include "grasping/closure.h"
#include "grasping/equilibrium.h"
#include "grasping/quality.h"
#include "support/closing_hand.h"

namespace rex::hand_test {

using Eigen::Vector3d;
using namespace closing_hand;

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

}  // namespace rex::hand_test
