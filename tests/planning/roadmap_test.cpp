#include "planning/roadmap.h"

#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "planning/wall.h"
#include "support/expect_error.h"

namespace rex::roadmap_test {

Roadmap roadmapOf(const PathProblem& problem, const RoadmapOptions& options, std::uint64_t seed = 1) {
  Rng rng(seed);
  return Roadmap(problem.space, problem.allValid, problem.resolution, options, rng);
}

// The second opinion: Dijkstra over all pairs of nodes, by rounds of relaxing every edge (Bellman and Ford).
double shortestByRelaxing(const Roadmap& roadmap, const Space& space, int from, int to) {
  std::vector<double> cost(static_cast<std::size_t>(roadmap.nodes()), 1e9);
  cost[static_cast<std::size_t>(from)] = 0;
  const auto edges = roadmap.edges();
  for (bool isChanged = true; isChanged;) {
    isChanged = false;
    for (const auto& [a, b] : edges) {
      const double length = space.distance(roadmap.node(a), roadmap.node(b));
      double &one = cost[static_cast<std::size_t>(a)], &other = cost[static_cast<std::size_t>(b)];
      if (one + length < other - 1e-12) other = one + length, isChanged = true;
      if (other + length < one - 1e-12) one = other + length, isChanged = true;
    }
  }
  return cost[static_cast<std::size_t>(to)];
}

TEST(Roadmap, IsFreeAndAnswersWithTheShortestWay) {
  PathProblem problem = wallWithHole(2, .3);
  EdgeChecker checker(problem.space, problem.allValid, problem.resolution);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Roadmap roadmap = roadmapOf(problem, {.nodes = 200}, seed);
    ASSERT_EQ(roadmap.nodes(), 200);
    const PathResult result = roadmap.query(problem);
    ASSERT_EQ(result.status, PathStatus::kFound) << result.message;
    for (const auto& [a, b] : roadmap.edges()) EXPECT_TRUE(checker.isValid(roadmap.node(a), roadmap.node(b)));
    EXPECT_EQ(result.path.col(0), problem.start);
    EXPECT_EQ(result.path.rightCols(1), problem.goal);
    EXPECT_NEAR(result.length, shortestByRelaxing(roadmap, problem.space, 200, 201), 1e-9);
    EXPECT_NEAR(result.length, pathLength(problem.space, result.path), 1e-12);
  }
}

TEST(Roadmap, AnswersLazilyWithTheSameWaysForLess) {
  const PathProblem problem = wallWithHole(2, .3);
  EdgeChecker checker(problem.space, problem.allValid, problem.resolution);
  Roadmap lazy = roadmapOf(problem, {.nodes = 400, .lazy = true});
  Roadmap eager = roadmapOf(problem, {.nodes = 400});
  const PathResult first = lazy.query(problem), again = lazy.query(problem);
  ASSERT_EQ(first.status, PathStatus::kFound);
  for (Eigen::Index k = 1; k < first.path.cols(); ++k)
    EXPECT_TRUE(checker.isValid(first.path.col(k - 1), first.path.col(k)));
  EXPECT_NEAR(first.length, shortestByRelaxing(lazy, problem.space, 400, 401), .3)
      << "unchecked edges may be shorter";
  EXPECT_LE(again.length, first.length + 1e-9);
  EXPECT_LT(again.asked, first.asked) << "what it has learnt";
  EXPECT_EQ(eager.query(problem).status, PathStatus::kFound);
}

// The mean over seeds falls with the budget. In six dimensions, where a thousand nodes are three to a side,
// it is still far from the optimum.
TEST(Roadmap, ComesNearerToTheShortestPathWithMoreNodes) {
  const struct {
    int dimension, few, factor;
    double gap, shortest, within;
  } cases[] = {{2, 400, 3, .1, 1.089949, 1.02}, {3, 500, 3, .2, 1.2, 1.13}, {6, 1000, 2, .4, 1.235783, 1.95}};
  for (const auto& one : cases) {
    const PathProblem problem = wallWithHole(one.dimension, one.gap);
    double last = std::numeric_limits<double>::infinity();
    for (const int nodes : {one.few, one.few * one.factor, one.few * one.factor * one.factor}) {
      constexpr int kSeeds = 3;
      double mean = 0;
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const PathResult result = roadmapOf(problem, {.nodes = nodes, .neighbors = 0}, seed).query(problem);
        ASSERT_EQ(result.status, PathStatus::kFound) << result.message << one.dimension;
        EXPECT_GT(result.length, one.shortest - 2 * problem.resolution);
        mean += result.length / kSeeds;
      }
      EXPECT_LT(mean, last) << one.dimension << " dimensions, " << nodes << " nodes";
      last = mean;
    }
    EXPECT_LT(last, one.within * one.shortest) << one.dimension;
  }
}

// In six dimensions nodes are far between, unless they are drawn where a shorter way may lead than is known.
TEST(Roadmap, ComesNearerByNodesBetweenStartAndGoal) {
  const PathProblem problem = wallWithHole(6, .4);
  Rng rng(1);
  std::vector<double> lengths{3};
  for (int stage = 0; stage < 5; ++stage) {
    RoadmapOptions options{.nodes = 2000, .neighbors = 100, .maxSamples = 1'000'000};
    options.sampler = informedSampler(problem.space, problem.start, problem.goal, lengths.back());
    Roadmap roadmap(problem.space, problem.allValid, problem.resolution, options, rng);
    const PathResult result = roadmap.query(problem);
    ASSERT_EQ(result.status, PathStatus::kFound) << result.message;
    lengths.push_back(std::min(lengths.back(), result.length));
  }
  EXPECT_LT(lengths.back(), .9 * lengths[1]);
  EXPECT_LT(lengths.back(), 1.47 * 1.235783);
}

TEST(Roadmap, SaysWhenThereIsNoWay) {
  const PathProblem problem = wallWithHole(2, 0);
  for (const bool lazy : {false, true}) {
    const PathResult result = roadmapOf(problem, {.nodes = 200, .lazy = lazy}).query(problem);
    EXPECT_EQ(result.status, PathStatus::kBudgetSpent);
    EXPECT_EQ(result.path.cols(), 0);
    EXPECT_NE(result.message.find("no path in a roadmap of 202 nodes"), std::string::npos) << result.message;
  }
  const Roadmap few = roadmapOf(problem, {.nodes = 200, .maxSamples = 50});
  EXPECT_LE(few.nodes(), 50);
}

TEST(Roadmap, EndsWithWhatItFoundWhenTheTimeIsUp) {
  PathProblem problem = wallWithHole(2, .3);
  for (const bool lazy : {false, true}) {
    int asked = 0;
    const auto isTimeUp = [&] { return ++asked > 100; };
    Roadmap roadmap = roadmapOf(problem, {.nodes = 200, .lazy = lazy, .isTimeUp = isTimeUp});
    EXPECT_LE(roadmap.nodes(), 100);
    EXPECT_TRUE(roadmap.edges().empty()) << "the time is up for joining, too";
  }
  Roadmap lazy = roadmapOf(problem, {.nodes = 200, .lazy = true});
  problem.isTimeUp = [] { return true; };
  EXPECT_EQ(lazy.query(problem).status, PathStatus::kBudgetSpent);
}

TEST(Roadmap, RefusesWhatItCannotMake) {
  const PathProblem problem = wallWithHole(2, .1);
  EXPECT_REX_ERROR(roadmapOf(problem, {.nodes = 0}), "nodes of a roadmap: found 0, wanted at least 1");
  EXPECT_REX_ERROR(roadmapOf(problem, {.neighbors = -1}),
                   "neighbours in a roadmap: found -1, wanted at least 1, or 0");
  EXPECT_REX_ERROR(roadmapOf(problem, {.maxSamples = 0}), "number of samples: found 0, wanted at least 1");
}

}  // namespace rex::roadmap_test
