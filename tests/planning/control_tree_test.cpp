#include "planning/control_tree.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/car_curves.h"
#include "planning/phase_space.h"
#include "support/expect_error.h"
#include "systems/car.h"
#include "systems/mobile_bases.h"
#include "systems/planar_quadrotor.h"

namespace rex::control_tree_test {

constexpr double kSteering = .6;

ControlSystem carSystem() {
  const Car car{.wheelbase = .3, .maxSteering = kSteering};
  return {.space = Space::se2({0, 0}, {4, 4}, .3),
          .lower = Eigen::Vector2d(-1, -kSteering),
          .upper = Eigen::Vector2d(1, kSteering),
          .motion = [car](const VectorArg& x, const VectorArg& u, double seconds) -> Eigen::VectorXd {
            return driveCar(car, x, u, seconds);
          }};
}

// A lot with a wall that leaves a gate.
PathProblem lot() {
  return {.space = Space::se2({0, 0}, {4, 4}, .3),
          .allValid = eachColumn([](const VectorArg& q) {
            const bool isInside = q[0] > 0 && q[0] < 4 && q[1] > 0 && q[1] < 4;
            return isInside && (std::abs(q[0] - 2) > .1 || q[1] > 2.8);
          }),
          .start = Eigen::Vector3d(.5, .5, 0),
          .goal = Eigen::Vector3d(3.5, .5, -1.5)};
}

void expectDriven(const ControlSystem& system, const PathProblem& problem, const ControlTreeOptions& options,
                  const ControlPath& path) {
  ASSERT_EQ(path.found.status, PathStatus::kFound) << path.found.message;
  ASSERT_EQ(path.controls.size() + 1, static_cast<std::size_t>(path.found.path.cols()));
  EXPECT_EQ(path.found.path.col(0), problem.start);
  Eigen::Index at = 0;
  for (const auto& [u, seconds] : path.controls) {
    const Eigen::VectorXd x = path.found.path.col(at++);
    EXPECT_TRUE((u.array() >= system.lower.array()).all() && (u.array() <= system.upper.array()).all());
    EXPECT_TRUE(seconds >= options.shortest && seconds <= options.longest);
    EXPECT_LT((system.motion(x, u, seconds) - path.found.path.col(at)).norm(), 1e-12);
    const int checks = static_cast<int>(std::ceil(seconds / options.checkEvery));
    for (int i = 1; i <= checks; ++i)
      EXPECT_TRUE(problem.allValid(system.motion(x, u, seconds * i / checks)));
  }
  EXPECT_LE(system.space.distance(path.found.path.rightCols<1>(), problem.goal), options.tolerance);
}

TEST(ControlTree, DrivesACarThroughAGate) {
  const ControlSystem system = carSystem();
  const PathProblem problem = lot();
  const ControlTreeOptions options{.tolerance = .25, .maxSamples = 60000};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    expectDriven(system, problem, options, growControlTree(system, problem, options, rng));
  }
}

TEST(ControlTree, TakesTheDistanceOfTheSystem) {
  ControlSystem system = carSystem();
  system.distance = [](const VectorArg& from, const VectorArg& to) {
    return reedsSheppLength(from, to, .3 / std::tan(kSteering));
  };
  const PathProblem problem = lot();
  const ControlTreeOptions options{.tolerance = .4, .maxSamples = 4000};
  Rng rng(1), again(1);
  const ControlPath path = growControlTree(system, problem, options, rng);
  ASSERT_EQ(path.found.status, PathStatus::kFound) << path.found.message;
  EXPECT_LE(system.distance(path.found.path.rightCols<1>(), problem.goal), options.tolerance);
  EXPECT_EQ(growControlTree(system, problem, options, again).found.path, path.found.path)
      << "same seed, same path";
}

// What slide 4:53 says: without targets a tree hardly leaves its start.
TEST(ControlTree, ExploresLessByRandomControls) {
  const ControlSystem system = carSystem();
  PathProblem problem = lot();
  problem.goal = Eigen::Vector3d(3.9, 3.9, 3);
  const auto reach = [&](bool towardsTargets) {
    Rng rng(3);
    const ControlPath path = growControlTree(
        system, problem,
        {.towardsTargets = towardsTargets, .goalBias = 0, .tolerance = 0, .maxSamples = 1000}, rng);
    EXPECT_EQ(path.found.status, PathStatus::kBudgetSpent);
    EXPECT_TRUE(path.controls.empty());
    const Eigen::MatrixXd& nodes = path.found.trees[0].nodes;
    return (nodes.topRows<2>().colwise() - problem.start.head<2>()).colwise().norm().mean();
  };
  EXPECT_GT(reach(true), 1.3 * reach(false));
}

// Steps towards targets end when their time is over, after any number of controls.
TEST(ControlTree, CutsSteeringShort) {
  ControlSystem system = carSystem();
  system.steer = [](const VectorArg& from, const VectorArg&) -> std::vector<HeldControl> {
    if (from[0] > 3) return {};  // it knows no way from there
    return {{Eigen::Vector2d(1, 0), .2}, {Eigen::Vector2d(1, .5), 0}, {Eigen::Vector2d(1, -.5), .7}};
  };
  PathProblem problem = lot();
  problem.allValid = eachColumn([](const VectorArg&) { return true; });
  const ControlTreeOptions options{.shortest = .3, .longest = .4, .tolerance = 0, .maxSamples = 300};
  Rng rng(1);
  const ControlPath path = growControlTree(system, problem, options, rng);
  const PathTree& tree = path.found.trees[0];
  ASSERT_EQ(path.edges.size(), tree.parents.size());
  int steps = 0, whole = 0;
  for (std::size_t k = 1; k < path.edges.size(); ++k) {
    const auto& [u, seconds] = path.edges[k];
    const Eigen::VectorXd from = tree.nodes.col(tree.parents[k]);
    EXPECT_LT((system.motion(from, u, seconds) - tree.nodes.col(static_cast<Eigen::Index>(k))).norm(), 1e-12);
    if (u[1] == 0) {
      EXPECT_EQ(seconds, .2);
      EXPECT_LE(from[0], 3);
    } else {
      EXPECT_EQ(tree.parents[k], static_cast<int>(k) - 1);
      const bool isWhole = seconds == .7;
      EXPECT_TRUE(isWhole || (seconds > .1 - 1e-12 && seconds < .2)) << seconds;
      ++(isWhole ? whole : steps);
    }
  }
  EXPECT_GT(steps, 10);
  EXPECT_GT(whole, 10) << "towards the goal";
}

// Any motion model: a differential drive gets through the gate, and a trailer and a quadrotor move as they
// must.
TEST(ControlTree, MovesAsAnyModelSays) {
  const Space plane = Space::se2({0, 0}, {4, 4}, .3);
  const MotionModel drive = motionModel(DifferentialDrive{});
  const ControlSystem wheels =
      controlSystem(drive, plane, Eigen::Vector2d(-20, -20), Eigen::Vector2d(20, 20));
  const ControlTreeOptions options{.tolerance = .3, .maxSamples = 60000};
  Rng rng(1);
  expectDriven(wheels, lot(), options, growControlTree(wheels, lot(), options, rng));
  using Kind = SpacePart::Kind;
  const SpacePart side{.lower = 0, .upper = 4}, angle{.kind = Kind::kCircle}, speed{.lower = -3, .upper = 3};
  const auto expectEdges = [&](const MotionModel& model, const Space& space, const VectorArg& lower,
                               const VectorArg& upper) {
    PathProblem problem{.space = space, .allValid = eachColumn([](const VectorArg&) { return true; })};
    problem.start = Eigen::VectorXd::Zero(model.states);
    problem.goal = Eigen::VectorXd::Constant(model.states, 2.5);
    const ControlPath path = growControlTree(controlSystem(model, space, lower, upper), problem,
                                             {.tolerance = 0, .maxSamples = 200}, rng);
    const PathTree& tree = path.found.trees.at(0);
    ASSERT_EQ(tree.parents.size(), 201u);
    for (std::size_t k = 1; k < tree.parents.size(); ++k) {
      const Eigen::VectorXd from = tree.nodes.col(tree.parents[k]), to = tree.nodes.col(static_cast<int>(k));
      EXPECT_LT((meanAfter(model, from, path.edges[k].u, path.edges[k].seconds) - to).norm(), 1e-12);
    }
  };
  expectEdges(motionModel(CarWithTrailer{{2}, 2}), Space({side, side, angle, angle}),
              Eigen::Vector2d(-1, -.6), Eigen::Vector2d(1, .6));
  expectEdges(motionModel(PlanarQuadrotor{}), Space({side, side, angle, speed, speed, speed}),
              Eigen::Vector2d(0, 0), Eigen::Vector2d(5, 5));
  const Eigen::Vector2d two(1, 1);
  EXPECT_REX_ERROR(controlSystem(drive, Space::box(-two, two), -two, two), "space of a motion model: found");
  EXPECT_REX_ERROR(controlSystem(drive, plane, Eigen::Vector3d(0, 0, 0), two), "lower bounds of controls");
  EXPECT_REX_ERROR(controlSystem(drive, plane, -two, Eigen::Vector3d(0, 0, 0)), "upper bounds of controls");
  EXPECT_REX_ERROR(controlSystem({.states = 3, .controls = 2}, plane, -two, two), "motion model: found no");
}

TEST(ControlTree, SaysWhatIsWrong) {
  const ControlSystem system = carSystem();
  const PathProblem problem = lot();
  Rng rng(1);
  const auto grow = [&](const ControlSystem& one, const ControlTreeOptions& options) {
    static_cast<void>(growControlTree(one, problem, options, rng));
  };
  EXPECT_REX_ERROR(grow(system, {.shortest = 0}),
                   "shortest duration of controls: found 0 s, wanted a positive, finite number of seconds");
  EXPECT_REX_ERROR(grow(system, {.longest = INFINITY}), "longest duration of controls: found inf s");
  EXPECT_REX_ERROR(grow(system, {.shortest = 2, .longest = 1}),
                   "shortest duration of controls: found 2 s, wanted at most the longest, 1 s");
  EXPECT_REX_ERROR(grow(system, {.checkEvery = 0}), "time between checks of a motion: found 0 s");
  EXPECT_REX_ERROR(grow(system, {.trials = 0}), "trials of controls: found 0, wanted at least 1");
  EXPECT_REX_ERROR(grow(system, {.maxSamples = 0}), "number of samples: found 0, wanted at least 1");
  EXPECT_REX_ERROR(grow(system, {.goalBias = -1}),
                   "goal bias of a tree: found -1, wanted a number from 0 to 1");
  EXPECT_REX_ERROR(grow(system, {.tolerance = NAN}),
                   "tolerance of a goal: found nan, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(grow(system, {.tolerance = INFINITY}), "tolerance of a goal: found inf");
  ControlSystem broken = system;
  broken.motion = {};
  EXPECT_REX_ERROR(grow(broken, {}),
                   "control system: found no motion, wanted a function that gives the state after a motion");
  broken.motion = [](const VectorArg& x, const VectorArg&, double) -> Eigen::VectorXd { return x * NAN; };
  EXPECT_REX_ERROR(grow(broken, {}), "motion from (0.5, 0.5, 0) by (");
  broken.motion = [](const VectorArg& x, const VectorArg&, double) -> Eigen::VectorXd { return x.head(2); };
  EXPECT_REX_ERROR(grow(broken, {}), "state after a motion: found a vector of size 2, wanted size 3");
  broken = system;
  broken.distance = [](const VectorArg&, const VectorArg&) { return NAN; };
  EXPECT_REX_ERROR(
      grow(broken, {}),
      "distance from (0.5, 0.5, 0) to (3.5, 0.5, -1.5): found not a number, wanted a number, 0 or more");
  broken = system;
  broken.steer = [](const VectorArg&, const VectorArg&) {
    return std::vector<HeldControl>{{Eigen::Vector2d(.5, 0), 1}, {Eigen::Vector2d(0, 2), 1}};
  };
  EXPECT_REX_ERROR(
      grow(broken, {}),
      "steering from (0.5, 0.5, 0) to (3.5, 0.5, -1.5): found (0, 2) for 1 s, wanted controls from "
      "(-1, -0.6) to (1, 0.6), for 0 s or more");
  broken.steer = [](const VectorArg&, const VectorArg&) {
    return std::vector<HeldControl>{{Eigen::Vector2d(.5, 0), -1}};
  };
  EXPECT_REX_ERROR(grow(broken, {}), "found (0.5, 0) for -1 s");
  broken.steer = [](const VectorArg&, const VectorArg&) {
    return std::vector<HeldControl>{{Eigen::VectorXd::Zero(3), 1}};
  };
  EXPECT_REX_ERROR(grow(broken, {}), "control that steers: found a vector of size 3, wanted size 2");
  broken = system;
  broken.upper = Eigen::VectorXd::Ones(3);
  EXPECT_REX_ERROR(grow(broken, {}), "upper bounds of controls: found a vector of size 3, wanted size 2");
}

}  // namespace rex::control_tree_test
