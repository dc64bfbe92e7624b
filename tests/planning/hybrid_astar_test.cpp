#include "planning/hybrid_astar.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "parking.h"
#include "planning/car_curves.h"
#include "planning/control_tree.h"
#include "planning/robot_problem.h"
#include "support/expect_error.h"

namespace rex::hybrid_astar_test {

using parking::kCar;
using parking::Lot;

double apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], std::remainder(a[2] - b[2], 2 * M_PI));
}

// The poses of a path every 2 cm, by the velocity of the car in small steps: the second opinion on arcs.
Eigen::MatrixXd integrated(const Eigen::Vector3d& start, const std::vector<HeldControl>& controls) {
  std::vector<Eigen::Vector3d> poses{start};
  for (const HeldControl& one : controls) {
    const int steps = std::max(1, static_cast<int>(std::ceil(one.seconds / .02)));
    const double h = one.seconds / steps;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector3d q = poses.back(), middle = q + h / 2 * carVelocity(kCar, q, one.u);
      poses.push_back(q + h * carVelocity(kCar, middle, one.u));
    }
  }
  Eigen::MatrixXd all(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = poses[i];
  return all;
}

// The cost of a path as the options say, from its controls.
double costOf(const std::vector<HeldControl>& controls, const HybridAStarOptions& options) {
  double cost = 0;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const auto& [u, seconds] = controls[i];
    cost += seconds * (u[0] < 0 ? options.reverseFactor : 1);
    if (i == 0) continue;
    const Eigen::VectorXd& before = controls[i - 1].u;
    cost +=
        (u[0] * before[0] < 0 ? options.switchCost : 0) + options.steeringCost * std::abs(u[1] - before[1]);
  }
  return cost;
}

// It can be driven, costs what it says, and touches nothing: proven between the checked poses, too, by the
// collision module, and by a second measure at the poses.
void expectDriven(const Lot& lot, const CarPath& path, const HybridAStarOptions& options) {
  ASSERT_EQ(path.driven.found.status, PathStatus::kFound) << path.driven.found.message;
  const Eigen::MatrixXd poses = integrated(lot.problem.start, path.driven.controls);
  EXPECT_LT(apart(poses.rightCols<1>(), lot.problem.goal), 1e-3);
  EXPECT_LT(apart(path.driven.found.path.rightCols<1>(), lot.problem.goal), 1e-9);
  for (const auto& q : poses.colwise()) EXPECT_GT(parking::separation(lot, q), 0);
  const Space space = Space::box(Eigen::Vector3d::Constant(-1e3), Eigen::Vector3d::Constant(1e3));
  EXPECT_GT(pathClearance(lot.model, lot.contacts, space, poses).atLeast, 0);
  EXPECT_NEAR(path.cost, costOf(path.driven.controls, options), 1e-9);
  EXPECT_LE(path.leastCost, path.cost);
  EXPECT_GE((1 + options.slack) * path.leastCost, path.cost - 1e-8);
  double length = 0;
  int switches = 0;
  for (std::size_t i = 0; i < path.driven.controls.size(); ++i) {
    const auto& [u, seconds] = path.driven.controls[i];
    EXPECT_EQ(std::abs(u[0]), 1);
    EXPECT_LE(std::abs(u[1]), kCar.maxSteering);
    length += seconds;
    if (i > 0) switches += u[0] != path.driven.controls[i - 1].u[0] ? 1 : 0;
  }
  EXPECT_NEAR(length, path.length, 1e-9);
  EXPECT_EQ(switches, path.switches);
  EXPECT_GE(path.length, reedsSheppLength(lot.problem.start, lot.problem.goal, kCar.turningRadius()) - 1e-9);
}

Lot meadow(const Eigen::Vector3d& start, const Eigen::Vector3d& goal) {
  return parking::lotOf({{{0, 14, 0}, 1, 1}}, {-15, -15}, {15, 15}, start, goal, 0);
}

// Where nothing is in the way, the shortest path is that of Reeds and Shepp. With curves tried only within
// 2 m of the end, the arcs of a coarse grid must get there: they are longer by a few percent.
TEST(HybridAStar, TakesTheShortestPathWhereNothingIsInTheWay) {
  Rng rng(1);
  double excess = 0;
  constexpr int kPairs = 10;
  for (int i = 0; i < kPairs; ++i) {
    SCOPED_TRACE(i);
    const auto pose = [&] {
      return Eigen::Vector3d(rng.uniform(-6, 6), rng.uniform(-6, 6), rng.uniform(-3, 3));
    };
    const Eigen::Vector3d start = pose();
    const Lot lot = meadow(start, pose());
    const double shortest = reedsSheppLength(start, lot.problem.goal, kCar.turningRadius());
    HybridAStarOptions options{.cellSize = .25,
                               .headings = 72,
                               .reverseFactor = 1,
                               .switchCost = 0,
                               .steeringCost = 0,
                               .slack = 0,
                               .fromGoal = i % 2 == 0};
    const CarPath path = findCarPath(kCar, lot.problem, options);
    expectDriven(lot, path, options);
    EXPECT_NEAR(path.cost, shortest, 1e-9);
    EXPECT_EQ(path.expanded, 1);

    options.analyticReach = 2;
    const CarPath arcs = findCarPath(kCar, lot.problem, options);
    expectDriven(lot, arcs, options);
    EXPECT_GT(arcs.expanded, 1);
    excess += arcs.length / shortest - 1;
  }
  EXPECT_LT(excess / kPairs, .05);
}

// A tree of Reeds-Shepp drives parks, too, but costs more by the same account.
TEST(HybridAStar, ParksBetweenTwoCars) {
  const HybridAStarOptions options{};
  for (const double gap : {5.6, 6.2}) {
    SCOPED_TRACE(gap);
    const Lot lot = parking::street(gap, .03);
    const CarPath path = findCarPath(kCar, lot.problem, options);
    expectDriven(lot, path, options);
    EXPECT_LE(path.switches, gap > 6 ? 2 : 4);
    if (gap < 6) continue;
    Rng rng(1);
    const ControlPath tree =
        growControlTree(reedsSheppCar(lot.problem.space, kCar), lot.problem,
                        {.shortest = .5, .longest = 4, .tolerance = 1e-6, .maxSamples = 2000}, rng);
    ASSERT_EQ(tree.found.status, PathStatus::kFound) << tree.found.message;
    EXPECT_LT(path.cost, costOf(tree.controls, options));
  }
}

// In a corridor that is too narrow for a U, a car turns by going back and forth, more often where it is
// narrower.
TEST(HybridAStar, TurnsInThreePoints) {
  const HybridAStarOptions options{.cellSize = .25, .headings = 72, .switchCost = 3, .slack = .3};
  for (const double width : {9., 7.}) {
    SCOPED_TRACE(width);
    const Lot lot = parking::lotOf({{{0, -.15, 0}, 30, .3}, {{0, width + .15, 0}, 30, .3}}, {-14, 0},
                                   {14, width}, {-3, width / 2, 0}, {-3, width / 2, M_PI}, .05);
    const CarPath path = findCarPath(kCar, lot.problem, options);
    expectDriven(lot, path, options);
    EXPECT_EQ(path.switches, width > 8 ? 2 : 4);
  }
}

TEST(HybridAStar, RefusesASlotThatIsTooShort) {
  const Lot lot = parking::street(4.6, .03);
  const CarPath path = findCarPath(kCar, lot.problem);
  EXPECT_EQ(path.driven.found.status, PathStatus::kBudgetSpent);
  EXPECT_TRUE(path.isExhausted);
  EXPECT_TRUE(path.driven.controls.empty());
  EXPECT_EQ(path.driven.found.path.cols(), 0);
  EXPECT_TRUE(std::isinf(path.cost));
  EXPECT_THAT(
      path.driven.found.message,
      ::testing::MatchesRegex("no path on this grid: the goal is reached from only [0-9]+ states, and "
                              "none of them leads on"));
  const CarPath spent = findCarPath(kCar, lot.problem, {.fromGoal = false, .maxExpanded = 50});
  EXPECT_FALSE(spent.isExhausted);
  EXPECT_EQ(spent.driven.found.message, "no path found: 50 states expanded");
  // Seen from the start of the way out, it is the start that has no room.
  Lot out = lot;
  std::swap(out.problem.start, out.problem.goal);
  const CarPath stuck = findCarPath(kCar, out.problem, {.fromGoal = false});
  EXPECT_TRUE(stuck.isExhausted);
  EXPECT_THAT(stuck.driven.found.message,
              ::testing::MatchesRegex("no path on this grid: the car gets from its start to only [0-9]+ "
                                      "states, and none of them leads on"));
}

TEST(HybridAStar, SaysWhatIsWrong) {
  const Lot lot = meadow({0, 0, 0}, {1, 1, 1});
  const auto find = [&](const HybridAStarOptions& options) {
    return findCarPath(kCar, lot.problem, options);
  };
  EXPECT_REX_ERROR(find({.cellSize = 0}),
                   "size of cells: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(find({.headings = 3}), "cells of a whole turn: found 3, wanted at least 4");
  EXPECT_REX_ERROR(find({.steeringAngles = 1}), "steering angles: found 1, wanted at least 3");
  EXPECT_REX_ERROR(find({.steeringAngles = 4}), "steering angles: found 4, wanted an odd number");
  EXPECT_REX_ERROR(find({.reverseFactor = .5}),
                   "cost of a metre backward: found 0.5, wanted a finite number, 1 or");
  EXPECT_REX_ERROR(find({.switchCost = -1}), "cost of a change of direction: found -1");
  EXPECT_REX_ERROR(find({.steeringCost = NAN}), "cost of steering: found nan");
  EXPECT_REX_ERROR(find({.analyticReach = -1}), "reach of analytic curves: found -1 m");
  EXPECT_REX_ERROR(find({.slack = -1}), "slack of a search: found -1");
  EXPECT_REX_ERROR(find({.maxExpanded = 0}), "number of expanded states: found 0, wanted at least 1");
  EXPECT_REX_ERROR(findCarPath({.wheelbase = 0}, lot.problem), "wheelbase of a car: found 0 m");
  EXPECT_REX_ERROR(findCarPath({.maxSteering = 0}, lot.problem), "turning radius: found inf m");
  PathProblem problem = lot.problem;
  problem.resolution = 0;
  EXPECT_REX_ERROR(findCarPath(kCar, problem), "resolution: found 0");
  problem = lot.problem;
  problem.space = Space::box(Eigen::Vector3d::Constant(-9), Eigen::Vector3d::Constant(9));
  EXPECT_REX_ERROR(findCarPath(kCar, problem), "space of a car: found 3 parts, wanted x, y and heading");
  problem = lot.problem;
  problem.goal = Eigen::Vector3d(0, 13, 0);
  EXPECT_REX_ERROR(findCarPath(kCar, problem), "goal: found 'world#1' and 'car#1' 0.4 m in overlap");
}

}  // namespace rex::hybrid_astar_test
