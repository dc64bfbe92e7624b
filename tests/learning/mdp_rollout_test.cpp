#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/mdp.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::mdp_rollout_test {

// 4.5 standard errors, each of 12: one failure in 10^4 seeds.
TEST(MdpRollout, MeanReturnIsTheValue) {
  Rng rng(5);
  for (int round = 0; round < 12; ++round) {
    const Mdp mdp = randomMdp(8, 3, round % 2 ? .9 : 1, rng, 2);
    const Eigen::MatrixXd policy = randomPolicy(mdp, rng);
    const ReturnEstimate estimate = estimatedReturn(mdp, policy, round % 8, 4000, 2000, rng);
    EXPECT_NEAR(estimate.mean, policyValues(mdp, policy).V[round % 8], 4.5 * estimate.standardError);
    EXPECT_LT(estimate.standardError, .3);
    EXPECT_EQ(estimate.cut, 0);
  }
}

TEST(MdpRollout, EpisodesFollowTheProcess) {
  Rng rng(6);
  const Mdp maze = tMaze();
  const MdpEpisode left = mdpEpisode(maze, deterministicPolicy(maze, {0, 1, 0, 0, 0, 0, 0}), 0, 10, rng);
  EXPECT_EQ(left.states, (std::vector<int>{0, 1, 4}));
  EXPECT_EQ(left.actions, (std::vector<int>{0, 1, 0}));
  EXPECT_TRUE(left.ended);
  const MdpEpisode right = mdpEpisode(maze, deterministicPolicy(maze, {1, 1, 1, 0, 0, 0, 0}), 0, 10, rng);
  EXPECT_EQ(right.discountedReturn, .75);
  const MdpEpisode cut = mdpEpisode(maze, uniformPolicy(maze), 0, 2, rng);
  EXPECT_EQ(cut.states.size(), 2u);
  EXPECT_FALSE(cut.ended);
  EXPECT_EQ(estimatedReturn(maze, uniformPolicy(maze), 0, 5, 2, rng).cut, 5);
}

TEST(MdpRollout, SameSeedSameEpisodes) {
  Rng seed(1);
  const Mdp mdp = randomMdp(8, 3, .9, seed);
  Rng one(2), two(2), other(3);
  const auto states = [&](Rng& rng) { return mdpEpisode(mdp, uniformPolicy(mdp), 0, 100, rng).states; };
  const std::vector<int> first = states(one);
  EXPECT_EQ(first, states(two));
  EXPECT_NE(first, states(other));
}

TEST(MdpRollout, RefusesWrongInput) {
  Rng rng(1);
  const Mdp maze = tMaze();
  const Eigen::MatrixXd policy = uniformPolicy(maze);
  EXPECT_REX_ERROR(mdpEpisode(maze, policy, 7, 10, rng),
                   "start of an episode: found state 7, wanted one of 0");
  EXPECT_REX_ERROR(mdpEpisode(maze, policy, -1, 10, rng), "start of an episode: found state -1");
  EXPECT_REX_ERROR(mdpEpisode(maze, policy, 0, 0, rng), "steps of an episode: found 0, wanted at least 1");
  EXPECT_REX_ERROR(mdpEpisode(maze, policy.leftCols(1), 0, 9, rng), "policy: found 7 x 1");
  EXPECT_REX_ERROR(mdpEpisode(Mdp(), policy, 0, 9, rng), "rewards of the decision process");
  EXPECT_REX_ERROR(estimatedReturn(maze, policy, 0, 1, 10, rng), "episodes: found 1, wanted at least 2");
}

}  // namespace rex::mdp_rollout_test
