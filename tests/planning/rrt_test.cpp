// Trees in the unit cube with a wall, whose shortest lengths are known.
#include "planning/rrt.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/wall.h"
#include "support/expect_error.h"

namespace rex::rrt_test {

using Planner = std::function<PathResult(const PathProblem&, Rng&)>;

Planner rrt() {
  return [](const PathProblem& problem, Rng& rng) { return growRrt(problem, {.stepSize = .1}, rng); };
}
Planner connect() {
  return [](const PathProblem& problem, Rng& rng) { return connectRrts(problem, {.stepSize = .1}, rng); };
}
Planner star(int samples) {
  return [=](const PathProblem& problem, Rng& rng) {
    return growRrtStar(problem, {.growth = {.stepSize = .2, .maxSamples = samples}}, rng);
  };
}

void expectTree(const PathProblem& problem, const PathTree& tree, double stepSize) {
  for (Eigen::Index k = 0; k < tree.nodes.cols(); ++k) {
    const int parent = tree.parents[static_cast<std::size_t>(k)];
    if (parent < 0) continue;
    EXPECT_LT(parent, tree.nodes.cols());
    EXPECT_LE(problem.space.distance(tree.nodes.col(k), tree.nodes.col(parent)), stepSize + 1e-12);
    EXPECT_TRUE(problem.allValid(tree.nodes.col(k)));
  }
}

void expectPath(const PathProblem& problem, const PathResult& result) {
  ASSERT_EQ(result.status, PathStatus::kFound) << result.message;
  EXPECT_EQ(result.path.col(0), problem.start);
  EXPECT_EQ(result.path.rightCols(1), problem.goal);
  EXPECT_NEAR(result.length, pathLength(problem.space, result.path), 1e-12);
  EXPECT_GT(result.asked, 0);
}

TEST(Rrt, IsTheSameForTheSameSeed) {
  const PathProblem problem = wallWithHole(3, .3);
  for (const Planner& planner : {rrt(), connect(), star(500)}) {
    Rng one(7), again(7), other(8);
    const PathResult a = planner(problem, one), b = planner(problem, again), c = planner(problem, other);
    EXPECT_EQ(a.trees.front().nodes, b.trees.front().nodes);
    EXPECT_EQ(a.path, b.path);
    EXPECT_NE(a.trees.front().nodes.col(1), c.trees.front().nodes.col(1));
  }
}

TEST(Rrt, TakesNoLongerStepsOnAnglesMeasuredByChords) {
  const PathProblem problem{.space = Space({{.kind = SpacePart::Kind::kChord}}),
                            .allValid = eachColumn([](const VectorArg&) { return true; }),
                            .start = Eigen::VectorXd::Zero(1),
                            .goal = Eigen::VectorXd::Constant(1, 3.1)};
  Rng rng(1);
  const PathResult result = growRrt(problem, {.stepSize = .2, .goalBias = 1}, rng);
  expectPath(problem, result);
  expectTree(problem, result.trees.front(), .2);
}

TEST(Rrt, StaysWhereTheGoalIsTheStart) {
  PathProblem problem = wallWithHole(2, .3);
  for (const double apart : {0., .05}) {
    problem.goal = problem.start + Eigen::Vector2d(apart, 0);
    for (const Planner& planner : {rrt(), connect(), star(100)}) {
      Rng rng(1);
      const PathResult result = planner(problem, rng);
      expectPath(problem, result);
      EXPECT_NEAR(result.length, apart, 1e-15);
    }
    Rng rng(1);
    EXPECT_EQ(rrt()(problem, rng).samples + connect()(problem, rng).samples, 0);
  }
}

TEST(Rrt, SaysWhenTheBudgetIsSpent) {
  const PathProblem problem = wallWithHole(2, 0);
  Rng rng(1);
  const PathResult result = connectRrts(problem, {.stepSize = .1, .maxSamples = 300}, rng);
  EXPECT_EQ(result.status, PathStatus::kBudgetSpent);
  EXPECT_EQ(result.samples, 300);
  EXPECT_EQ(result.path.cols(), 0);
  EXPECT_EQ(result.trees.size(), 2u);
  EXPECT_GT(result.trees[0].nodes.cols(), 20) << "what was explored is there to be seen";
  EXPECT_NE(result.message.find("no path after 300 samples"), std::string::npos) << result.message;
}

TEST(Rrt, EndsWithWhatItExploredWhenTheTimeIsUp) {
  PathProblem problem = wallWithHole(2, 0);
  for (const Planner& planner : {rrt(), connect(), star(300)}) {
    int asked = 0;
    problem.isTimeUp = [&] { return ++asked > 100; };
    Rng rng(1);
    const PathResult result = planner(problem, rng);
    EXPECT_EQ(result.status, PathStatus::kBudgetSpent);
    EXPECT_EQ(result.samples, 100);
    EXPECT_GT(result.trees[0].nodes.cols(), 10);
  }
}

TEST(Rrt, PlansWhereAnglesCloseUp) {
  // A bar at heading 0 bars the way; it leads through pi.
  const PathProblem problem{.space = Space::se2({0, 0}, {1, 1}),
                            .allValid = eachColumn([](const VectorArg& q) {
                              return std::abs(std::remainder(q[2], 2 * M_PI)) > .5;
                            }),
                            .start = Eigen::Vector3d(.5, .5, 2.5),
                            .goal = Eigen::Vector3d(.5, .5, -2.5)};
  Rng rng(3);
  const PathResult result = connectRrts(problem, {.stepSize = 10}, rng);
  expectPath(problem, result);
  EXPECT_LT(result.length, 5) << "not the long way round";
}

TEST(RrtStar, ComesNearTheShortestPath) {
  const struct {
    int dimension;
    double gap, shortest, within, stepSize;
    int samples, seeds;
  } cases[] = {{2, .1, 1.089949, 1.01, .2, 6000, 3},
               {3, .2, 1.2, 1.05, .5, 8000, 3},
               {6, .4, 1.235783, 1.3, 1, 12000, 1}};
  for (const auto& one : cases) {
    const PathProblem problem = wallWithHole(one.dimension, one.gap);
    const auto grown = [&](int samples, bool isInformed, int seed) {
      Rng rng(static_cast<std::uint64_t>(seed));
      const RrtOptions growth{.stepSize = one.stepSize, .maxSamples = samples};
      return growRrtStar(problem, {.growth = growth, .isInformed = isInformed}, rng);
    };
    for (int seed = 0; seed < one.seeds; ++seed) {
      const PathResult early = grown(one.samples / 4, true, seed), late = grown(one.samples, true, seed);
      expectPath(problem, late);
      EXPECT_LT(late.length, one.within * one.shortest) << one.dimension;
      EXPECT_GT(late.length, one.shortest - 2 * problem.resolution) << one.dimension;
      ASSERT_EQ(early.status, PathStatus::kFound);
      EXPECT_LE(late.length, early.length + 1e-12);
      EXPECT_LT(late.length, grown(one.samples, false, seed).length) << "what targets that matter are for";
    }
  }
}

// Short steps fill the square before the goal is met; then only the few nodes between start and goal count.
TEST(RrtStar, LooksAsFarAsTheNodesThatMatterAskFor) {
  const Space square = Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  const PathProblem problem{.space = square,
                            .allValid = eachColumn([](const VectorArg&) { return true; }),
                            .start = Eigen::Vector2d(.45, .5),
                            .goal = Eigen::Vector2d(.55, .5)};
  double excess = 0;
  constexpr int kSeeds = 20;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Rng rng(seed);
    const RrtOptions growth{.stepSize = .03, .goalBias = 0, .maxSamples = 3000};
    const PathResult result = growRrtStar(problem, {.growth = growth}, rng);
    expectPath(problem, result);
    excess += (result.length / .1 - 1) / kSeeds;
  }
  EXPECT_LT(excess, .01);
}

// 1/d and 1/(d+1): with the latter, more edges are worth a test, and the same samples lead to shorter paths.
TEST(RrtStar, ConvergesWithBothExponents) {
  const PathProblem problem = wallWithHole(2, .1);
  constexpr double kShortest = 1.089949;
  constexpr int kSeeds = 10;
  struct {
    double excess = 0, asked = 0;
  } early[2], late[2];
  const auto grown = [&](double exponent, int samples, std::uint64_t seed) {
    Rng rng(seed);
    const RrtOptions growth{.stepSize = .3, .maxSamples = samples};
    const RrtStarOptions options{.growth = growth, .exponent = exponent, .isInformed = false};
    return growRrtStar(problem, options, rng);
  };
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    EXPECT_EQ(grown(0, 1000, seed).path, grown(1. / 2, 1000, seed).path);
    for (const int k : {0, 1})
      for (auto* mean : {&early[k], &late[k]}) {
        const PathResult result = grown(1. / (2 + k), mean == &early[k] ? 1000 : 8000, seed);
        expectPath(problem, result);
        mean->excess += (result.length / kShortest - 1) / kSeeds;
        mean->asked += static_cast<double>(result.asked) / kSeeds;
      }
  }
  for (const int k : {0, 1}) EXPECT_LT(late[k].excess, early[k].excess / 2);
  EXPECT_LT(late[1].excess, late[0].excess);
  EXPECT_GT(late[1].asked, 1.2 * late[0].asked);
}

TEST(RrtStar, FindsTheGoalWithoutEverAimingAtIt) {
  const Space square = Space::box(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1));
  const PathProblem problem{.space = square,
                            .allValid = eachColumn([](const VectorArg&) { return true; }),
                            .start = Eigen::Vector2d(.1, .1),
                            .goal = Eigen::Vector2d(.9, .8)};
  Rng rng(5);
  const RrtOptions growth{.stepSize = .1, .goalBias = 0, .maxSamples = 2000};
  const PathResult result = growRrtStar(problem, {.growth = growth}, rng);
  expectPath(problem, result);
  expectTree(problem, result.trees.front(), .1);
  EXPECT_LT(result.length, 1.05 * std::hypot(.8, .7));
}

TEST(Rrt, RefusesWhatItCannotPlan) {
  PathProblem problem = wallWithHole(2, .1);
  Rng rng(1);
  const auto plan = [&](const RrtOptions& options) { static_cast<void>(growRrt(problem, options, rng)); };
  EXPECT_REX_ERROR(plan({.stepSize = 0}), "step size of a tree: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(plan({.goalBias = 1.5}), "goal bias of a tree: found 1.5, wanted a number from 0 to 1");
  EXPECT_REX_ERROR(plan({.maxSamples = 0}), "number of samples: found 0, wanted at least 1");
  for (const double gamma : {-1., std::nan(""), double{INFINITY}})
    EXPECT_REX_ERROR(growRrtStar(problem, {.gamma = gamma}, rng),
                     fmt::format("gamma of RRT*: found {:g}, wanted a finite number, 0 or more", gamma));
  EXPECT_REX_ERROR(growRrtStar(problem, {.exponent = -1}, rng), "exponent of RRT*: found -1");
  problem.resolution = 0;
  EXPECT_REX_ERROR(plan({}), "resolution of a path check: found 0, wanted a positive, finite number");
  problem = wallWithHole(2, .1);
  problem.goal[0] = .5;
  EXPECT_REX_ERROR(plan({}), "goal: found a configuration that is not valid, wanted a valid one");
  problem.reason = [](const VectorArg& q) { return "a wall " + std::to_string(q[0] - .45) + " away"; };
  EXPECT_REX_ERROR(plan({}), "goal: found a wall 0.05");
  problem.start[1] = 1.5;
  EXPECT_REX_ERROR(plan({}), "start: number 1: found 1.5, wanted at most 1: it is 0.5 above");
  problem.start = Eigen::Vector3d(0, 0, 0);
  EXPECT_REX_ERROR(plan({}), "start: found a vector of size 3, wanted size 2");
}

TEST(Rrt, NamesTheConfigurationOfAClearanceThatIsNoNumber) {
  PathProblem problem = wallWithHole(2, .5);
  problem.allValid = whereClear([](const VectorArg& q) { return q[0] > .5 ? NAN : 1.; });
  problem.goal[0] = .3;
  Rng rng(1);
  EXPECT_REX_ERROR(static_cast<void>(growRrt(problem, {.goalBias = 0, .maxSamples = 10000}, rng)),
                   "clearance at (0.5");
}

}  // namespace rex::rrt_test
