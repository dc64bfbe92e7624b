#include "learning/mdp.h"

#include <limits>

#include <gtest/gtest.h>

#include "learning/mazes.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::mdp_test {

TEST(Mdp, SaysWhatIsWrongAndWhere) {
  const Mdp good = tMaze();
  EXPECT_NO_THROW(requireMdp(good));
  Mdp mdp;
  EXPECT_REX_ERROR(requireMdp(mdp), "rewards of the decision process: found 0 x 0, wanted states x actions");
  mdp = good;
  mdp.transitions.pop_back();
  EXPECT_REX_ERROR(requireMdp(mdp), "transition matrices, one for each action");
  mdp = good;
  mdp.terminal.pop_back();
  EXPECT_REX_ERROR(requireMdp(mdp), "terminal, one for each state");
  mdp = good;
  mdp.transitions[1].resize(7, 6);
  EXPECT_REX_ERROR(requireMdp(mdp), "transitions of action 1: found 7 x 6, wanted 7 x 7");
  for (const double discount : {-.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    mdp = good;
    mdp.discount = discount;
    EXPECT_REX_ERROR(requireMdp(mdp), "discount: found");
  }
  mdp = good;
  mdp.rewards(4, 1) = std::numeric_limits<double>::infinity();
  EXPECT_REX_ERROR(requireMdp(mdp), "reward of action 1 in state 4: found inf, wanted a finite number");
}

TEST(Mdp, SaysWhichRowIsNoDistribution) {
  Mdp mdp = tMaze();
  mdp.transitions[0].coeffRef(2, 5) = .5;
  EXPECT_REX_ERROR(requireMdp(mdp),
                   "transition of action 0 from state 2: found probabilities that sum to 0.5");
  mdp.transitions[0].coeffRef(2, 5) = 1 + 1e-8;
  EXPECT_REX_ERROR(requireMdp(mdp), "found probabilities that sum to 1.00000001");
  mdp.transitions[0].coeffRef(2, 5) = 1 + 1e-10;
  EXPECT_NO_THROW(requireMdp(mdp));
  mdp.transitions[0].coeffRef(2, 5) = -.5;
  EXPECT_REX_ERROR(requireMdp(mdp),
                   "transition of action 0 from state 2 to state 5: found -0.5, wanted a probability");
  mdp.transitions[0].coeffRef(2, 5) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(requireMdp(mdp), "from state 2 to state 5: found nan");
  mdp = tMaze();
  mdp.transitions[1].coeffRef(6, 0) = 1;
  EXPECT_REX_ERROR(requireMdp(mdp), "from state 6: found probabilities that sum to 1, wanted none, because");
}

TEST(Mdp, SaysWhatIsWrongWithAPolicy) {
  const Mdp mdp = tMaze();
  EXPECT_NO_THROW(requirePolicy(mdp, uniformPolicy(mdp)));
  EXPECT_REX_ERROR(requirePolicy(mdp, Eigen::MatrixXd::Zero(2, 7)),
                   "policy: found 2 x 7, wanted states x ac");
  Eigen::MatrixXd policy = uniformPolicy(mdp);
  policy(3, 1) = .6;
  EXPECT_REX_ERROR(requirePolicy(mdp, policy), "policy in state 3: found probabilities that sum to 1.1");
  policy(3, 1) = .5 + 1e-8;
  EXPECT_REX_ERROR(requirePolicy(mdp, policy),
                   "policy in state 3: found probabilities that sum to 1.00000001");
  policy(3, 1) = -1;
  EXPECT_REX_ERROR(requirePolicy(mdp, policy), "policy in state 3, action 1: found -1, wanted a probability");
  EXPECT_REX_ERROR(deterministicPolicy(mdp, {0, 1}), "actions, one for each state");
  EXPECT_REX_ERROR(deterministicPolicy(mdp, {0, 1, 0, 0, 2, 0, 0}),
                   "action in state 4: found 2, wanted one of 0 to 1");
  EXPECT_REX_ERROR(epsilonGreedy(policy, 1.5), "epsilon: found 1.5");
  EXPECT_REX_ERROR(epsilonGreedy(policy.leftCols(0), .5), "values of actions: found no action");
  EXPECT_REX_ERROR(greedyActions(policy.leftCols(0)), "values of actions: found no action");
  EXPECT_REX_ERROR(actionValues(mdp, Eigen::VectorXd::Zero(6)), "values, one for each state");
}

TEST(Mdp, ExpectsRewardsOnEntering) {
  Rng rng(3);
  const Mdp mdp = randomMdp(6, 3, .9, rng);
  const Eigen::VectorXd entered = rng.normalVector(6);
  const Eigen::MatrixXd rewards = rewardsOnEntering(mdp.transitions, entered);
  for (int s = 0; s < 6; ++s)
    for (int a = 0; a < 3; ++a) {
      double sum = 0;
      for (int t = 0; t < 6; ++t)
        sum += mdp.transitions[static_cast<std::size_t>(a)].coeff(s, t) * entered[t];
      EXPECT_NEAR(rewards(s, a), sum, 1e-14);
    }
  EXPECT_REX_ERROR(rewardsOnEntering(mdp.transitions, entered.head(5)),
                   "rows of the transitions of action 0");
  EXPECT_REX_ERROR(rewardsOnEntering({TransitionMatrix(6, 5)}, entered),
                   "columns of the transitions of action 0");
}

TEST(Mdp, ActsGreedily) {
  Eigen::MatrixXd Q(3, 3);
  Q << 1, 3, 2, 5, 5, 4, -1, -2, -.5;
  EXPECT_EQ(greedyActions(Q), (std::vector<int>{1, 0, 2}));
  const Eigen::MatrixXd policy = epsilonGreedy(Q, .3);
  EXPECT_NEAR(policy(0, 1), .8, 1e-15);
  EXPECT_NEAR(policy(2, 0), .1, 1e-15);
  EXPECT_LT((policy.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-15);
}

}  // namespace rex::mdp_test
