#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "parking.h"
#include "planning/car_curves.h"
#include "planning/control_tree.h"
#include "planning/robot_problem.h"
#include "support/expect_error.h"

namespace rex::car_steering_test {

using parking::kCar;
using parking::Lot;

// The second opinion on motions: the velocity of the car in small steps by the midpoint rule.
Eigen::Vector3d integrated(const Eigen::Vector3d& from, const HeldControl& control) {
  constexpr int kSteps = 500;
  const double h = control.seconds / kSteps;
  Eigen::Vector3d q = from;
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Vector3d middle = q + h / 2 * carVelocity(kCar, q, control.u);
    q += h * carVelocity(kCar, middle, control.u);
  }
  return q;
}

double apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], std::remainder(a[2] - b[2], 2 * M_PI));
}

double secondsOf(const std::vector<HeldControl>& controls) {
  double all = 0;
  for (const HeldControl& one : controls) all += one.seconds;
  return all;
}

TEST(CarSteering, EndsWhereItSays) {
  const Space space = Space::se2({-20, -20}, {20, 20});
  Rng rng(1);
  for (const bool isForward : {true, false}) {
    const ControlSystem system = isForward ? dubinsCar(space, kCar, 2) : reedsSheppCar(space, kCar, 2);
    for (int i = 0; i < 200; ++i) {
      SCOPED_TRACE(i);
      const Eigen::Vector3d from(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-4, 4));
      Eigen::Vector3d to(rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(-4, 4));
      if (i == 0) to = from;
      if (i == 1) to = from + 1e-8 * Eigen::Vector3d::Ones();
      const std::vector<HeldControl> controls = system.steer(from, to);
      Eigen::Vector3d q = from;
      for (const HeldControl& one : controls) {
        q = integrated(q, one);
        EXPECT_LE(std::abs(one.u[1]), kCar.maxSteering);
        EXPECT_TRUE(std::abs(one.u[0]) == 2 && (!isForward || one.u[0] > 0));
        EXPECT_GE(one.seconds, 0);
      }
      EXPECT_LT(apart(q, to), 2e-4);  // of the midpoint rule
      EXPECT_NEAR(2 * secondsOf(controls), system.distance(from, to), 1e-9);
    }
  }
}

// All edges come from their controls, and touch nothing: by the collision module between the checked states,
// too, and by a second measure.
void expectDriven(const Lot& lot, const ControlPath& path) {
  const PathTree& tree = path.found.trees.at(0);
  ASSERT_EQ(path.edges.size(), tree.parents.size());
  for (std::size_t k = 1; k < path.edges.size(); ++k) {
    const Eigen::Vector3d from = tree.nodes.col(tree.parents[k]);
    EXPECT_LT(apart(integrated(from, path.edges[k]), tree.nodes.col(static_cast<Eigen::Index>(k))), 1e-4);
  }
  ASSERT_EQ(path.found.path.cols(), static_cast<Eigen::Index>(path.controls.size()) + 1);
  EXPECT_EQ(path.found.path.col(0), lot.problem.start);
  for (std::size_t k = 0; k < path.controls.size(); ++k) {
    const HeldControl& one = path.controls[k];
    const Eigen::Vector3d from = path.found.path.col(static_cast<Eigen::Index>(k));
    const int pieces = static_cast<int>(std::ceil(one.seconds / .05));
    Eigen::MatrixXd poses(3, pieces + 1);
    for (int i = 0; i <= pieces; ++i) {
      poses.col(i) = driveCar(kCar, from, one.u, one.seconds * i / pieces);
      EXPECT_GT(parking::separation(lot, poses.col(i)), 0);
    }
    EXPECT_LT(apart(poses.rightCols<1>(), path.found.path.col(static_cast<Eigen::Index>(k) + 1)), 1e-12);
    // The chord of 5 cm is at most .1 mm from the arc, at any point of the car.
    const Space space = Space::box(Eigen::Vector3d::Constant(-1e3), Eigen::Vector3d::Constant(1e3));
    EXPECT_GT(pathClearance(lot.model, lot.contacts, space, poses).atLeast, 1e-3);
  }
}

TEST(CarSteering, ParksBetweenTwoCars) {
  const Lot lot = parking::street(6.2);
  const ControlSystem system = reedsSheppCar(lot.problem.space, kCar);
  const ControlTreeOptions options{.shortest = .5, .longest = 4, .tolerance = 1e-6, .maxSamples = 2000};
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    Rng rng(seed);
    const ControlPath path = growControlTree(system, lot.problem, options, rng);
    ASSERT_EQ(path.found.status, PathStatus::kFound) << path.found.message;
    expectDriven(lot, path);
    EXPECT_LT(apart(path.found.path.rightCols<1>(), lot.problem.goal), 1e-6);
  }
  // A car that only drives forward does not get in. It gets out if its outer front corner passes that of the
  // car ahead, both w from their middles: it needs sqrt(ahead^2 + 4 radius w) from its rear axle (Blackburn,
  // The geometry of perfect parking, 2009).
  const ControlSystem forward = dubinsCar(lot.problem.space, kCar);
  ControlTreeOptions fewer = options;
  fewer.maxSamples = 300;
  Rng rng(1);
  EXPECT_EQ(growControlTree(forward, lot.problem, fewer, rng).found.status, PathStatus::kBudgetSpent);
  const double needed =
      std::sqrt(parking::kAhead * parking::kAhead + 4 * kCar.turningRadius() * parking::kWidth / 2) +
      lot.problem.goal[0] + .05;  // the margin
  for (const double more : {-.15, .15}) {
    Lot out = parking::street(2 * (needed + more));
    out.problem.start = out.problem.goal;
    out.problem.goal = Eigen::Vector3d(7, 4.5, 0);
    const ControlPath path = growControlTree(forward, out.problem, fewer, rng);
    EXPECT_EQ(path.found.status, more > 0 ? PathStatus::kFound : PathStatus::kBudgetSpent) << more;
    for (const HeldControl& one : path.controls) EXPECT_EQ(one.u[0], 1);
  }
}

TEST(CarSteering, TakesTheShortestCurveWhereNothingIsInTheWay) {
  Lot lot = parking::street(6);
  lot.problem.allValid = eachColumn([](const VectorArg&) { return true; });
  Rng rng(1);
  const ControlPath path = growControlTree(reedsSheppCar(lot.problem.space, kCar, .5), lot.problem, {}, rng);
  EXPECT_EQ(path.found.samples, 0);
  EXPECT_NEAR(.5 * secondsOf(path.controls),
              reedsSheppLength(lot.problem.start, lot.problem.goal, kCar.turningRadius()), 1e-9);
}

TEST(CarSteering, SaysWhatIsWrong) {
  const Space space = Space::se2({0, 0}, {1, 1});
  EXPECT_REX_ERROR(controlsAlong(dubinsCurve({0, 0, 0}, {1, 1, 0}, 2), kCar),
                   "radius of a curve: found 2 m, wanted at least the turning radius of the car, 3.80");
  EXPECT_REX_ERROR(controlsAlong(Curve(), kCar, 0),
                   "speed of a car: found 0 m/s, wanted a positive, finite number of metres per second");
  EXPECT_REX_ERROR(dubinsCar(space, kCar, -1), "speed of a car: found -1 m/s");
  EXPECT_REX_ERROR(reedsSheppCar(Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)), kCar),
                   "space of a car: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(reedsSheppCar(space, {.wheelbase = -1}), "wheelbase of a car: found -1 m");
  EXPECT_REX_ERROR(reedsSheppCar(space, {.maxSteering = 0}), "turning radius: found inf m");
}

}  // namespace rex::car_steering_test
