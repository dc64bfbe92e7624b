#include "planning/potential_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::potential_field_test {

using Eigen::Vector2d;

// A map of 20 x 20 cells of half a metre with a box in it.
GridMap box() {
  GridMap map(20, 20, .5);
  for (int y = 8; y <= 11; ++y)
    for (int x = 8; x <= 11; ++x) map.setBlocked({x, y});
  return map;
}

TEST(PotentialField, HasTheGradientOfItsPotential) {
  const PotentialField field(box(), {9, 9.5}, {.attraction = .5, .repulsion = 2, .reach = 1.5});
  Rng rng(1);
  int felt = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector2d p = rng.uniformVector(2, 0, 10);
    if (!std::isfinite(field.potential(p)) || field.potential(p) > 50) continue;
    // Where another corner or side becomes the nearest, there is no derivative.
    const auto U = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, field.potential(x)); };
    const Eigen::VectorXd numeric = numericJacobian(U, p, 1e-5).transpose();
    EXPECT_LT((numeric - field.gradient(p)).norm(), 1e-5 * (1 + numeric.norm())) << p.transpose();
    felt += (field.gradient(p) - .5 * (p - field.goal())).norm() > 1e-9 ? 1 : 0;
  }
  EXPECT_GT(felt, 50);
}

TEST(PotentialField, IsWhatTheSlidesSay) {
  const PotentialField field(box(), {9, 9.5}, {.attraction = .5, .repulsion = 2, .reach = 1.5});
  EXPECT_NEAR(field.potential({1, 1}), .25 * (64 + 72.25), 1e-12) << "far from all";
  const double nearness = 1 / .5 - 1 / 1.5;  // half a metre left of the box, which begins at x = 4
  EXPECT_NEAR(field.potential({3.5, 5}), .25 * (5.5 * 5.5 + 4.5 * 4.5) + nearness * nearness, 1e-12);
  EXPECT_TRUE(std::isinf(field.potential({5, 5})));
}

TEST(PotentialField, LeadsAroundWhatIsNotInTheWay) {
  const PotentialField field(box(), {9, 9.5}, {.reach = 1});
  const Descent descent = descend(field, {1, 2}, .05);
  ASSERT_EQ(descent.status, DescentStatus::kReached);
  double last = INFINITY;
  for (const Vector2d& p : descent.points) {
    EXPECT_TRUE(std::isfinite(field.potential(p)));
    EXPECT_LT(field.potential(p), last);
    last = field.potential(p);
  }
  EXPECT_LE((descent.points.back() - field.goal()).norm(), .05);
}

// The trap of slide 4:16: an obstacle that is open towards the start.
TEST(PotentialField, IsCaughtInATrapAndSaysSo) {
  GridMap map(20, 20, .5);
  for (int i = 6; i <= 13; ++i)
    for (const GridCell cell : {GridCell{12, i}, {i, 6}, {i, 13}}) map.setBlocked(cell);
  const PotentialField field(map, {9.5, 5});
  const Descent descent = descend(field, {1, 5}, .05);
  EXPECT_EQ(descent.status, DescentStatus::kLocalMinimum);
  EXPECT_LT(descent.points.back().x(), 6) << "before the wall";
  EXPECT_EQ(descend(field, {1, 5}, .05, 3).status, DescentStatus::kBudgetSpent);
  EXPECT_EQ(descend(field, {9.5, 5}, .05).status, DescentStatus::kReached);
}

TEST(PotentialField, RefusesWhatIsNoField) {
  EXPECT_REX_ERROR(PotentialField(box(), {5, 5}), "goal: found (5, 5), wanted a position outside obstacles");
  EXPECT_REX_ERROR(PotentialField(box(), {1, 1}, {.attraction = 0}),
                   "attraction: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(PotentialField(box(), {1, 1}, {.repulsion = -1}), "repulsion: found -1");
  EXPECT_REX_ERROR(PotentialField(box(), {1, 1}, {.reach = NAN}), "reach of obstacles: found nan");
  EXPECT_REX_ERROR(PotentialField(box(), {1, NAN}), "goal: found (1, nan)");
  const PotentialField field(box(), {1, 1});
  EXPECT_REX_ERROR(static_cast<void>(descend(field, {5, 5}, .1)), "start: found (5, 5)");
  EXPECT_REX_ERROR(static_cast<void>(descend(field, {1, 5}, 0)),
                   "step size: found 0, wanted a positive, finite number");
}

}  // namespace rex::potential_field_test
