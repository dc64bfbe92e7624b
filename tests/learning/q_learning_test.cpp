#include "learning/q_learning.h"

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/policy_values.h"
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

TEST(QLearning, RefusesWrongOptions) {
  Rng rng(1);
  EXPECT_REX_ERROR(qLearning(tMaze(), {.episodes = 0}, rng), "episodes: found 0, wanted at least 1");
  EXPECT_REX_ERROR(qLearning(tMaze(), {.maxSteps = 0}, rng), "steps of an episode: found 0");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.epsilon = -1}, rng), "epsilon: found -1, wanted a number in [0, 1]");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.stepExponent = .5}, rng),
                   "stepExponent: found 0.5, wanted a number above");
  EXPECT_REX_ERROR(sarsa(tMaze(), {.start = Eigen::Vector2d(1, 0)}, rng), "start distribution");
  EXPECT_REX_ERROR(sarsa(Mdp(), {}, rng), "rewards of the decision process");
}

}  // namespace rex::q_learning_test
