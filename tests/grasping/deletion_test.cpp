#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "grasping/closure.h"
#include "grasping/object_surface.h"
#include "support/expect_error.h"

namespace rex::deletion_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

std::vector<WrenchCone> chosen(const std::vector<WrenchCone>& cones, const std::vector<int>& kept,
                               int without = -1) {
  std::vector<WrenchCone> rest;
  for (const int i : kept)
    if (i != without) rest.push_back(cones[static_cast<std::size_t>(i)]);
  return rest;
}

bool holds(const std::vector<WrenchCone>& cones) {
  return !cones.empty() && forceClosure(primitiveWrenches(cones).wrenches).status == ClosureStatus::kClosed;
}

std::vector<int> shuffled(int count, Rng& rng) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (int i = count; i > 1; --i)
    std::swap(order[static_cast<std::size_t>(i - 1)], order[static_cast<std::size_t>(rng.index(i))]);
  return order;
}

// What is kept holds, each contact of it is needed, and there are at most 2 d.
void expectMinimal(const std::vector<WrenchCone>& cones, const DeletionSynthesis& result) {
  ASSERT_EQ(result.status, ClosureStatus::kClosed) << result.message;
  EXPECT_LE(result.kept.size(), 2 * static_cast<std::size_t>(cones[0].normal.size()));
  EXPECT_TRUE(holds(chosen(cones, result.kept)));
  for (const int i : result.kept) EXPECT_FALSE(holds(chosen(cones, result.kept, i)));
  EXPECT_TRUE(std::is_sorted(result.kept.begin(), result.kept.end()));
}

// Fingers all around a rectangle.
std::vector<WrenchCone> aroundRectangle(double friction) {
  std::vector<PlanarContact> contacts;
  for (const double s : {-0.9, -0.6, -0.3, 0., 0.3, 0.6, 0.9}) {
    contacts.push_back({{2 * s, -1}, {0, 1}, friction});
    contacts.push_back({{2 * s, 1}, {0, -1}, friction});
    contacts.push_back({{-2, s}, {1, 0}, friction});
    contacts.push_back({{2, s}, {-1, 0}, friction});
  }
  return wrenchCones(contacts);
}

TEST(DeletionSynthesis, KeepsAtMostSixFingersInThePlane) {
  Rng rng(71);
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<WrenchCone> cones = aroundRectangle(trial % 2 * 0.3);
    const DeletionSynthesis result = deleteRedundant(cones, shuffled(28, rng));
    expectMinimal(cones, result);
    EXPECT_GE(result.kept.size(), trial % 2 == 0 ? 4u : 2u);  // form closure needs d + 1
  }
}

TEST(DeletionSynthesis, KeepsAtMostTwelveFingersInSpace) {
  Rng rng(72);
  const ObjectSurface surface({.type = ShapeType::kBox, .extent = {1, 0.7, 0.5}});
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<WrenchCone> cones = wrenchCones(contactsAt(surface.sample(rng, 80), trial % 2 * 0.4));
    const DeletionSynthesis result = deleteRedundant(cones, shuffled(80, rng));
    expectMinimal(cones, result);
    EXPECT_GE(result.kept.size(), trial % 2 == 0 ? 7u : 2u);
  }
}

// Pairs of opposite wrenches along the axes need all 2 d, so the bound cannot be lower.
TEST(DeletionSynthesis, ReachesItsBound) {
  for (const int d : {3, 6}) {
    std::vector<WrenchCone> cones;
    for (int axis = 0; axis < d; ++axis)
      for (const double sign : {1., -1.})
        cones.push_back({sign * VectorXd::Unit(d, axis), MatrixXd::Zero(d, d / 3), 0});
    const DeletionSynthesis result = deleteRedundant(cones);
    expectMinimal(cones, result);
    EXPECT_EQ(result.kept.size(), static_cast<std::size_t>(2 * d));
    EXPECT_EQ(result.message, d == 3 ? "6 of 6 contacts hold" : "12 of 12 contacts hold");
  }
}

TEST(DeletionSynthesis, DeletesFirstWhatComesFirst) {
  std::vector<PlanarContact> contacts;
  for (int k = 0; k < 6; ++k) {
    const double angle = std::numbers::pi * k / 3;
    const Vector2d p(std::cos(angle), std::sin(angle));
    contacts.push_back({p, -p, 0.5});
  }
  const std::vector<WrenchCone> cones = wrenchCones(contacts);
  EXPECT_EQ(deleteRedundant(cones).kept, (std::vector{2, 5}));
  // Also seen from far away.
  EXPECT_EQ(deleteRedundant(wrenchCones(contacts, {{3e4, -7e4, 0}, 0.1})).kept, (std::vector{2, 5}));
  EXPECT_EQ(deleteRedundant(cones, std::vector{5, 4, 3, 2, 1, 0}).kept, (std::vector{0, 3}));
}

// A smooth ball can always turn: no number of fingers holds it.
TEST(DeletionSynthesis, SaysThatASmoothBallCannotBeHeld) {
  Rng rng(73);
  const ObjectSurface ball({.type = ShapeType::kSphere, .radius = 1});
  const DeletionSynthesis result = deleteRedundant(wrenchCones(contactsAt(ball.sample(rng, 200), 0)));
  EXPECT_EQ(result.status, ClosureStatus::kOpen);
  EXPECT_TRUE(result.kept.empty());
  EXPECT_EQ(result.message, "the wrenches span 3 of 6 dimensions");
  EXPECT_EQ(deleteRedundant({}).status, ClosureStatus::kOpen);
  EXPECT_EQ(deleteRedundant({}).message, "there are no contacts");
}

TEST(DeletionSynthesis, RefusesOtherOrders) {
  const std::vector<WrenchCone> cones = wrenchCones(std::vector<Contact>(3));
  EXPECT_REX_ERROR(deleteRedundant(cones, std::vector{0, 1, 1}),
                   "deletion synthesis: order: found 0 1 1, wanted each contact from 0 to 2 once");
  EXPECT_REX_ERROR(deleteRedundant(cones, std::vector{0, 1}), "deletion synthesis: order: found 0 1");
}

}  // namespace rex::deletion_test
