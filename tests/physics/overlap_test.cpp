// What starts in overlap comes apart, and is told.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"

namespace rex::overlap_test {

double fastestOf(PhysicsWorld& world, double seconds) {
  double fastest = 0;
  for (int i = 0; i < static_cast<int>(std::lround(seconds / 1e-3)); ++i) {
    world.step(1e-3);
    fastest = std::max(fastest, world.state().v.lpNorm<Eigen::Infinity>());
  }
  return fastest;
}

// Three boxes within one another, half of them in the ground.
Model tangle() {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "a", 1, boxShape(0.2, 0.2, 0.2), translation(0, 0, 0.02));
  addLoose(spec, "b", 0.1, boxShape(0.2, 0.2, 0.2), translation(0.12, 0, 0.1));
  addLoose(spec, "c", 10, boxShape(0.2, 0.2, 0.2), translation(0.05, 0.03, 0.25));
  return compile(spec);
}

TEST(PhysicsOverlap, IsToldPairByPair) {
  PhysicsWorld world(tangle());
  const std::vector<PhysicsContact> overlaps = world.overlaps();
  ASSERT_EQ(overlaps.size(), 3u);  // the ground and a, a and b, b and c
  EXPECT_EQ(overlaps[0].shapeA, 0);
  EXPECT_EQ(overlaps[0].shapeB, 1);
  EXPECT_NEAR(overlaps[0].distance, -0.08, 1e-6);
  EXPECT_EQ(overlaps[1].shapeB, 2);
  EXPECT_NEAR(overlaps[1].distance, -0.08, 1e-3);
  EXPECT_EQ(overlaps[1].impulse, 0);
  EXPECT_EQ(world.overlaps(0.09).size(), 0u);
}

TEST(PhysicsOverlap, AskingForItChangesNothing) {
  PhysicsWorld world(tangle()), asked(tangle());
  EXPECT_FALSE(asked.overlaps().empty());
  EXPECT_TRUE(asked.contacts().empty());
  for (PhysicsWorld* one : {&world, &asked}) one->step(0.2);
  EXPECT_EQ(world.state().q, asked.state().q);
}

TEST(PhysicsOverlap, ComesApartSlowly) {
  for (const double restitution : {0., 0.5}) {
    PhysicsWorld world(tangle(), {.restitution = restitution});
    EXPECT_LT(fastestOf(world, 3), 30);
    for (const PhysicsContact& left : world.overlaps()) EXPECT_GT(left.distance, -2e-3);
  }
  SceneSpec deep;
  addGround(deep);
  addLoose(deep, "ball", 1, ballShape(0.5), translation(0, 0, 0.1));
  PhysicsWorld world(compile(deep));
  EXPECT_LT(fastestOf(world, 2), 1.01);
  EXPECT_NEAR(world.state().q[2], 0.5, 1e-3);
  EXPECT_TRUE(world.overlaps().empty());
}

// A chain that is folded onto itself, and cannot come apart all at once.
TEST(PhysicsOverlap, OfARobotsOwnPartsStaysBounded) {
  SceneSpec spec;
  std::string parent = "world";
  for (int i = 0; i < 6; ++i) {
    const std::string name = "link" + std::to_string(i);
    JointSpec& joint = addHinged(spec, name, i % 2 == 0 ? 2 : 0.1, i % 2 == 0 ? 0.02 : 1e-4);
    joint.parent = parent;
    joint.X_PF = translation(i == 0 ? 0 : 0.3, 0, 0);
    ShapeSpec shape;
    shape.X_BS = translation(0.15, 0, 0);
    shape.shape = boxShape(0.28, 0.1, 0.1);
    shape.contact = true;
    spec.bodies.back().shapes.push_back(shape);
    spec.bodies.back().p_BBcm = Eigen::Vector3d(0.15, 0, 0);
    parent = name;
  }
  const Model model = compile(spec);
  for (const double fold : {3.14159, 3.0, 2.6}) {
    PhysicsWorld world(model);
    State state = initialState(model);
    state.q.tail(5).setConstant(fold);
    world.setState(state);
    EXPECT_GE(world.overlaps().size(), 3u);
    // It unfolds and falls, and its light ends whip. What bounds that is its energy: to lift all links by
    // their thickness takes 6.2 J, of which the push gives a tenth.
    const auto total = [&] { return energy(model, world.state().q, world.state().v).total(); };
    const double before = total();
    double most = before, fastest = 0;
    for (int i = 0; i < 3000; ++i) {
      world.step(1e-3);
      most = std::max(most, total());
      fastest = std::max(fastest, world.state().v.lpNorm<Eigen::Infinity>());
    }
    RecordProperty(fmt::format("fold {}", fold), fmt::format("{:.3g} rad/s", fastest));
    EXPECT_LT(most - before, 1) << fold;
    EXPECT_LT(fastest, 150) << fold;
  }
}

}  // namespace rex::overlap_test
