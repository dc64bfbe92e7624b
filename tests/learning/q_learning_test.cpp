#include "learning/q_learning.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::q_learning_test {

TEST(QLearning, NearsTheExactValues) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng(seed);
    const Mdp mdp = randomMdp(6, 2, .8, rng, 1);
    const Eigen::MatrixXd Q = policyIteration(mdp).Q;
    const TabularResult coarse = qLearning(mdp, {.episodes = 300, .epsilon = .5}, rng);
    const TabularResult fine = qLearning(mdp, {.episodes = 200000, .epsilon = .5, .stepExponent = .8}, rng);
    EXPECT_LT((fine.Q - Q).cwiseAbs().maxCoeff(), .05);
    EXPECT_LT((fine.Q - Q).norm(), .5 * (coarse.Q - Q).norm());
    EXPECT_EQ(fine.untried, 0);
  }
}

// With epsilon fixed it learns what acting so is worth, which is less than the optimum.
TEST(QLearning, SarsaNearsTheValuesOfWhatItDoes) {
  Rng rng(4);
  const GridWorld world = gridWorld("...\n.#G\n...", {.stepReward = -.1, .slip = .1});
  const TabularResult result = sarsa(world.mdp, {.episodes = 60000, .epsilon = .3}, rng);
  const Eigen::VectorXd V = policyValues(world.mdp, epsilonGreedy(result.Q, .3)).V;
  EXPECT_LT((result.Q - actionValues(world.mdp, V)).cwiseAbs().maxCoeff(), .03);
  EXPECT_GT((result.Q - policyIteration(world.mdp).Q).cwiseAbs().maxCoeff(), .06);
}

TEST(QLearning, SolvesTheTMaze) {
  Rng rng(5);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(7);
  start[0] = 1;
  const Mdp maze = tMaze();
  const TabularResult result = qLearning(maze, {.episodes = 5000, .epsilon = .2, .start = start}, rng);
  const Eigen::VectorXd V = result.Q.rowwise().maxCoeff();
  EXPECT_LT((V.head(3) - Eigen::Vector3d(1, 2, 1.5)).cwiseAbs().maxCoeff(), 1e-3);
  ASSERT_EQ(result.returns.size(), 5000u);
  for (const double R : result.returns) EXPECT_TRUE(R == 1 || R == 0 || R == .5 || R == .75);
  EXPECT_EQ(result.visits.topRows(1).sum(), 5000);
}

TEST(QLearning, CountsWhatItNeverTried) {
  Rng rng(6);
  Eigen::VectorXd start = Eigen::VectorXd::Zero(7);
  start[3] = 1;
  const TabularResult result = qLearning(tMaze(), {.episodes = 50, .epsilon = .5, .start = start}, rng);
  EXPECT_EQ(result.untried, 12);
  EXPECT_EQ(result.Q.topRows(3), Eigen::MatrixXd::Zero(3, 2));
}

TEST(QLearning, SameSeedSameTable) {
  Rng one(7), two(7);
  EXPECT_EQ(qLearning(tMaze(), {}, one).Q, qLearning(tMaze(), {}, two).Q);
  EXPECT_EQ(one.state(), two.state());
}

Eigen::VectorXd startAt(const GridWorld& world, int column, int row) {
  return Eigen::VectorXd::Unit(world.mdp.states(), world.state(column, row).value());
}

// Example 6.6 of Sutton and Barto: a step costs 1, a fall 100 and leads back to the start.
TEST(QLearning, WalksAlongTheCliffWhereSarsaKeepsAway) {
  const GridWorld world = gridWorld(
      "............\n............\n............\nSCCCCCCCCCCG",
      {.discount = 1,
       .stepReward = -1,
       .marks = {
           {'S', -1, false}, {'G', 0}, {.letter = 'C', .reward = -99, .isTerminal = false, .jumpTo = 'S'}}});
  const Eigen::VectorXd start = startAt(world, 0, 0);
  double onlineQ = 0, onlineSarsa = 0, rowsQ = 0, rowsSarsa = 0;
  const auto online = [](const TabularResult& result) {
    double sum = 0;
    for (std::size_t i = 400; i < 500; ++i) sum += result.returns[i] / 100;
    return sum;
  };
  // The row in which most steps to the east were tried in the middle of the map.
  const auto row = [&](const TabularResult& result) {
    int best = 1;
    for (int r = 2; r < 4; ++r)
      if (result.visits.row(world.state(6, r).value()).sum() >
          result.visits.row(world.state(6, best).value()).sum())
        best = r;
    return best;
  };
  constexpr int kRuns = 20;
  for (int i = 0; i < kRuns; ++i) {
    Rng rng(static_cast<std::uint64_t>(i));
    const TabularOptions options{
        .episodes = 500, .maxSteps = 5000, .epsilon = .1, .stepSize = .5, .start = start};
    const TabularResult best = qLearning(world.mdp, options, rng), taken = sarsa(world.mdp, options, rng);
    onlineQ += online(best) / kRuns;
    onlineSarsa += online(taken) / kRuns;
    rowsQ += static_cast<double>(row(best)) / kRuns;
    rowsSarsa += static_cast<double>(row(taken)) / kRuns;
    EXPECT_EQ(best.Q.row(world.state(0, 0).value()).maxCoeff(), -13);  // exactly: all are integers in the end
  }
  EXPECT_NEAR(onlineQ, -50, 8);
  EXPECT_NEAR(onlineSarsa, -25, 6);
  EXPECT_LT(rowsQ, 1.2);
  EXPECT_GT(rowsSarsa, 2.2);
}

// Example 8.1 of Sutton and Barto: 14 steps at best.
TEST(QLearning, DynaSolvesItsMazeInThreeEpisodes) {
  const GridWorld world =
      gridWorld(".......#G\n..#....#.\n..#....#.\n..#......\n.....#...\n.........", {.discount = .95});
  const Eigen::VectorXd start = startAt(world, 0, 3);
  const auto meanSteps = [&](int planning) {
    std::vector<double> mean(10, 0.);
    constexpr int kRuns = 30;
    for (int i = 0; i < kRuns; ++i) {
      Rng rng(static_cast<std::uint64_t>(i));
      const TabularResult result = qLearning(
          world.mdp,
          {.episodes = 10, .maxSteps = 100000, .stepSize = .1, .planningSteps = planning, .start = start},
          rng);
      for (std::size_t e = 0; e < mean.size(); ++e) mean[e] += static_cast<double>(result.steps[e]) / kRuns;
    }
    return mean;
  };
  const std::vector<double> none = meanSteps(0), five = meanSteps(5), fifty = meanSteps(50);
  // Nothing is learned before the goal is found, so the first episode is a random walk, however much is
  // planned.
  Mdp walk = world.mdp;
  walk.discount = 1;
  for (int s = 0; s < walk.states(); ++s) walk.rewards.row(s).setConstant(walk.isTerminal(s) ? 0 : -1);
  const double expected = -policyValues(walk, uniformPolicy(walk)).V.dot(start);
  EXPECT_NEAR((none[0] + five[0] + fifty[0]) / 3, expected, .4 * expected);
  EXPECT_NEAR(valueIteration(world.mdp).V.dot(start), std::pow(.95, 14), 1e-9);
  EXPECT_GT(none[3], 100);
  EXPECT_LT(five[5], 40);
  EXPECT_LT(fifty[3], 22);
  for (std::size_t e = 2; e < 5; ++e) {
    EXPECT_LT(fifty[e], five[e]);
    EXPECT_LT(five[e], none[e]);
  }
}

// Planning draws from what was seen, so it estimates the probabilities of a slippery floor, too.
TEST(QLearning, DynaNearsTheExactValues) {
  Rng rng(8);
  const Mdp mdp = randomMdp(5, 2, .8, rng, 1);
  const TabularResult result = qLearning(
      mdp, {.episodes = 20000, .maxSteps = 20, .epsilon = .5, .stepSize = .005, .planningSteps = 10}, rng);
  EXPECT_LT((result.Q - policyIteration(mdp).Q).cwiseAbs().maxCoeff(), .15);
}

TEST(QLearning, RefusesWrongOptions) {
  Rng rng(1);
  EXPECT_REX_ERROR(qLearning(tMaze(), {.episodes = 0}, rng), "episodes: found 0, wanted at least 1");
  EXPECT_REX_ERROR(qLearning(tMaze(), {.maxSteps = 0}, rng), "steps of an episode: found 0");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.epsilon = -1}, rng), "epsilon: found -1, wanted a number in [0, 1]");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.stepExponent = .5}, rng),
                   "stepExponent: found 0.5, wanted a number above");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.stepSize = 2}, rng), "stepSize: found 2, wanted a number in [0, 1]");
  EXPECT_REX_ERROR(qLearning(tMaze(), {.planningSteps = -1}, rng), "planning steps: found -1");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.planningSteps = 1}, rng),
                   "planning steps of SARSA: found 1, wanted none");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.start = Eigen::Vector2d(1, 0)}, rng), "start distribution");
  EXPECT_REX_ERROR(sarsa(Mdp(), {}, rng), "rewards of the decision process");
}

}  // namespace rex::q_learning_test
