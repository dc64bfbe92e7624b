// Contact against closed forms.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/rounds.h"

namespace rex::contact_test {

constexpr double kStep = 1e-3, kGravity = 9.81;

void run(PhysicsWorld& world, double seconds, double h = kStep) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / h)); ++i) world.step(h);
}

Model looseOnGround(const Shape& shape, const Pose& X_WB, const Pose& X_WG = {}) {
  SceneSpec spec;
  addGround(spec, X_WG);
  addLoose(spec, "thing", 2, shape, X_WB);
  return compile(spec);
}

// v first, then z with the new v: after n steps z has lost g h^2 n (n + 1) / 2.
TEST(PhysicsContacts, FallsAsItsIntegratorSays) {
  for (const Shape& shape : {boxShape(0.2, 0.3, 0.4), ballShape(0.1)}) {
    PhysicsWorld world(looseOnGround(shape, translation(0, 0, 10)));
    run(world, 1);
    const State state = world.state();
    EXPECT_NEAR(state.q[2], 10 - kGravity * kStep * kStep * 1000 * 1001 / 2, 1e-12);
    EXPECT_NEAR(state.q[2], 10 - kGravity / 2, kGravity * kStep / 2 + 1e-12);
    EXPECT_NEAR(state.v[2], -kGravity, 1e-12);
    EXPECT_NEAR(state.time, 1, 1e-12);
    EXPECT_TRUE(world.contacts().empty());
  }
}

TEST(PhysicsContacts, LiesWhereItsShapeTouches) {
  SceneSpec spec;
  addGround(spec);
  Shape rounded = boxShape(0.3, 0.2, 0.1);
  rounded.type = ShapeType::kRoundedBox;
  rounded.radius = 0.02;
  Shape cylinder = boxShape(0.2, 0.2, 0.1);
  cylinder.type = ShapeType::kCylinder;
  cylinder.radius = 0.1;
  Shape cone = cylinder;
  cone.type = ShapeType::kCone;
  Shape ellipsoid = boxShape(0.4, 0.3, 0.1);
  ellipsoid.type = ShapeType::kEllipsoid;
  const std::pair<Shape, double> cases[] = {{boxShape(0.2, 0.3, 0.4), 0.2},
                                            {ballShape(0.1), 0.1},
                                            {rounded, 0.05},
                                            {cylinder, 0.05},
                                            {cone, 0.05},
                                            {ellipsoid, 0.05}};
  double x = 0;
  for (const auto& [shape, height] : cases)
    addLoose(spec, "thing" + std::to_string(spec.bodies.size()), 1, shape, translation(x += 1, 0, height));
  PhysicsWorld world(compile(spec));
  run(world, 1);
  const State state = world.state();
  for (std::size_t i = 0; i < std::size(cases); ++i)
    EXPECT_NEAR(state.q[static_cast<int>(7 * i + 2)], cases[i].second, 2e-4) << i;
  // Bullet finds one point per step for round edges, so that these tremble.
  EXPECT_LT(state.v.norm(), 0.02);
}

// It slides v^2 / (2 mu g) far.
TEST(PhysicsContacts, SlidesUntilFrictionStopsIt) {
  const Model model = looseOnGround(boxShape(0.4, 0.4, 0.2), translation(0, 0, 0.1));
  PhysicsWorld world(model, {.friction = 0.4});
  State state = initialState(model);
  state.v[0] = 2;
  world.setState(state);
  run(world, 1);
  EXPECT_NEAR(world.state().q[0], 4 / (2 * 0.4 * kGravity), 2e-3);
  EXPECT_NEAR(world.state().v[0], 0, 1e-6);
}

TEST(PhysicsContacts, SlidesDownASlopeIfItIsSteeperThanItsFriction) {
  const double angle = std::atan(0.5);
  const Pose X_WG = rotation(angle, Eigen::Vector3d::UnitY());
  const Model model = looseOnGround(boxShape(0.4, 0.4, 0.2), X_WG * translation(0, 0, 0.1), X_WG);
  const auto wayIn = [&](double friction, double seconds) {
    PhysicsWorld world(model, {.friction = friction});
    run(world, seconds);
    return (world.state().q.head<3>() - model.initialPositions().head<3>()).norm();
  };
  const double slide = kGravity * (std::sin(angle) - 0.3 * std::cos(angle));
  EXPECT_NEAR(wayIn(0.3, 1), slide / 2, 0.01);
  EXPECT_LT(wayIn(0.55, 1), 1e-3);
  EXPECT_LT(wayIn(0.55, 10), 1e-3);
}

// What rests is held by its contacts alone: together they push against the weight. So for a single body, and
// for one with a part on a hinge, which Bullet treats differently, on slopes along x and y.
TEST(PhysicsContacts, CarryTheWeightOfWhatRests) {
  for (const bool hasPart : {false, true}) {
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(0.6, 0.8, 0), Eigen::Vector3d(0, -1, 0)}) {
      SceneSpec spec;
      const Pose X_WG = rotation(0.3, axis);
      addLoose(spec, "thing", 2, boxShape(0.4, 0.4, 0.2), X_WG * translation(0, 0, 0.1));
      addGround(spec, X_WG);
      double mass = 2;
      if (hasPart) {
        JointSpec& hinge = addHinged(spec, "part", 1, 0.01);
        hinge.parent = "thing";
        hinge.lower = hinge.upper = Eigen::VectorXd::Zero(1);
        mass = 3;
      }
      PhysicsWorld world(compile(spec), {.friction = 0.5});
      run(world, 2);
      Eigen::Vector3d impulse = Eigen::Vector3d::Zero(), friction = Eigen::Vector3d::Zero();
      for (const PhysicsContact& contact : world.contacts()) {
        EXPECT_NEAR(contact.friction_W.dot(contact.normal_W), 0, 1e-12);
        const double side = contact.normal_W.z() > 0 ? 1 : -1;  // whether the ground is B
        impulse += side * (contact.impulse * contact.normal_W + contact.friction_W);
        friction += side * contact.friction_W;
      }
      const double weight = mass * kGravity * kStep;
      EXPECT_LT((impulse - Eigen::Vector3d(0, 0, weight)).norm(), 1e-3 * weight) << impulse.transpose();
      EXPECT_NEAR(friction.norm(), weight * std::sin(0.3), 1e-3 * weight);
    }
  }
}

// With e of the speed it rises to e^2 of the height.
TEST(PhysicsContacts, BouncesByTheRestitution) {
  const Model model = looseOnGround(ballShape(0.1), translation(0, 0, 1.1));
  for (const double e : {0.0, 0.5, 0.8, 1.0}) {
    PhysicsWorld world(model, {.restitution = e});
    const double fall = std::sqrt(2 / kGravity);
    run(world, fall + 0.02);
    double highest = -1;
    const double flight = std::max(2 * e * fall, 0.1);
    for (int i = 0; i < static_cast<int>(flight / kStep); ++i) {
      world.step(kStep);
      highest = std::max(highest, world.state().q[2] - 0.1);
    }
    EXPECT_NEAR(highest, e * e, 0.02) << e;
  }
}

// A ball that falls 0.2 m, and leaves the ground at once with its whole speed.
TEST(PhysicsContacts, EventsSayWhatBeganAndEnded) {
  PhysicsWorld world(looseOnGround(ballShape(0.1), translation(0, 0, 0.3)), {.restitution = 1});
  const double fall = std::sqrt(2 * 0.2 / kGravity);
  world.step(0.1);
  EXPECT_TRUE(world.events().empty());
  world.step(0.15);
  ASSERT_EQ(world.events().size(), 2u);
  const ContactEvent begin = world.events()[0], end = world.events()[1];
  EXPECT_EQ(begin.kind, ContactEvent::Kind::kBegin);
  EXPECT_EQ(end.kind, ContactEvent::Kind::kEnd);
  for (const ContactEvent& event : {begin, end}) {
    EXPECT_EQ(event.shapeA, 0);
    EXPECT_EQ(event.shapeB, 1);
    EXPECT_NEAR(event.time, fall, 5 * kStep);
  }
  EXPECT_GT(end.time, begin.time);
  EXPECT_TRUE(world.contacts().empty());
  world.step(0.1);
  EXPECT_TRUE(world.events().empty());
}

TEST(PhysicsContacts, WhatLiesBeginsOnceUntilTheStateIsSet) {
  const Model model = looseOnGround(boxShape(0.2, 0.2, 0.2), translation(0, 0, 0.1));
  PhysicsWorld world(model);
  for (int round = 0; round < 2; ++round) {
    world.step(0.1);
    ASSERT_EQ(world.events().size(), 1u);
    EXPECT_EQ(world.events()[0].kind, ContactEvent::Kind::kBegin);
    world.step(1);
    EXPECT_TRUE(world.events().empty());
    EXPECT_FALSE(world.contacts().empty());
    world.setState(initialState(model));
    EXPECT_TRUE(world.events().empty());
  }
}

// Twenty boxes stay where they are for a minute.
TEST(PhysicsContacts, AStackStands) {
  SceneSpec spec;
  addGround(spec);
  for (int i = 0; i < 20; ++i)
    addLoose(spec, "box" + std::to_string(i), 1, boxShape(0.2, 0.2, 0.2), translation(0, 0, 0.1 + 0.2 * i));
  const Model model = compile(spec);
  PhysicsWorld world(model);
  double moved = 0, turned = 0;
  for (int second = 0; second < rounds(15, 60); ++second) {
    run(world, 1);
    const State state = world.state();
    for (int i = 0; i < 20; ++i) {
      moved = std::max(moved, (state.q - model.initialPositions()).segment<3>(7 * i).norm());
      turned = std::max(turned, logSO3(rotationFromQuaternion(state.q.segment<4>(7 * i + 3))).norm());
    }
  }
  RecordProperty("moved", std::to_string(moved));
  RecordProperty("turned", std::to_string(turned));
  EXPECT_LT(moved, 1e-3);
  EXPECT_LT(turned, 1e-3);
}

}  // namespace rex::contact_test
