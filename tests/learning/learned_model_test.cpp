#include "learning/learned_model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/mdp_rollout.h"
#include "learning/policy_values.h"
#include "learning/q_learning.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::learned_model_test {

TEST(LearnedModel, CountsWhatItSees) {
  LearnedModel model(3, 2);
  model.observe(0, 1, 2, 1);
  model.observe(0, 1, 4, 2);
  model.observe(0, 1, 0, 1);
  model.observe(2, 0, 5, std::nullopt);
  EXPECT_EQ(model.visits(0, 1), 3);
  const Mdp likely = model.mostLikely(1);
  EXPECT_DOUBLE_EQ(likely.transitions[1].coeff(0, 1), 2. / 3);
  EXPECT_DOUBLE_EQ(likely.rewards(0, 1), 2);
  EXPECT_EQ(likely.transitions[0].coeff(0, 0), 1);  // never tried
  EXPECT_TRUE(likely.isTerminal(2));
  EXPECT_EQ(likely.rewards(2, 0), 5);
  const Eigen::MatrixXd Q = valueIteration(model.optimistic(.5, 3, 7)).Q;
  EXPECT_NEAR(Q(0, 0), 14, 1e-9);
  EXPECT_NEAR(Q(0, 1), 2 + .5 * 14, 1e-9);
  EXPECT_EQ(Q(2, 0), 14);
}

// The values of the estimated process near those of the true one as 1 / sqrt(n).
TEST(LearnedModel, NearsTheTrueProcess) {
  Rng rng(1);
  const Mdp mdp = randomMdp(6, 2, .8, rng, 1);
  LearnedModel model(6, 2);
  const auto errorAfter = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const int s = rng.index(6), a = rng.index(2);
      model.observe(s, a, mdp.rewards(s, a),
                    mdp.isTerminal(s) ? std::nullopt : std::optional(sampledNext(mdp, s, a, rng)));
    }
    return (valueIteration(model.mostLikely(.8)).Q - valueIteration(mdp).Q).norm();
  };
  const double few = errorAfter(1000), many = errorAfter(99000);
  EXPECT_LT(many, .4 * few);
  EXPECT_LT(many, .05);
}

// A corridor where one step back loses everything: chance needs about 2^n trials, R-max a plan.
TEST(LearnedModel, RMaxFindsWhatChanceDoesNot) {
  constexpr int kLength = 16;
  Mdp chain{.rewards = Eigen::MatrixXd::Zero(kLength, 2), .discount = .95};
  chain.rewards(kLength - 1, 1) = 1;
  for (int a = 0; a < 2; ++a) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(kLength, kLength);
    for (int s = 0; s < kLength; ++s) P(s, a == 0 ? 0 : std::min(s + 1, kLength - 1)) = 1;
    chain.transitions.emplace_back(P.sparseView());
  }
  const Eigen::VectorXd start = Eigen::VectorXd::Unit(kLength, 0);
  Rng rng(2);
  const RMaxResult planned = rMax(chain, {.known = 1, .episodes = 20, .maxSteps = 40, .start = start}, rng);
  EXPECT_GT(planned.returns.back(), 0);
  const Eigen::MatrixXd Q = valueIteration(chain).Q;
  EXPECT_NEAR(planned.Q.row(0).maxCoeff(), Q.row(0).maxCoeff(), 1e-3);
  const TabularResult chance =
      qLearning(chain, {.episodes = 20, .maxSteps = 40, .epsilon = .1, .stepSize = .5, .start = start}, rng);
  EXPECT_EQ(chance.returns.back(), 0);
}

TEST(LearnedModel, RMaxActsWellOnASlipperyFloor) {
  const GridWorld world = gridWorld("....G\n.##.P\n.....", {.slip = .2, .marks = {{'G', 1}, {'P', -1}}});
  Rng rng(3);
  const RMaxResult result = rMax(world.mdp, {.known = 40, .episodes = 2000}, rng);
  const Eigen::VectorXd got = policyValues(world.mdp, policyOf(world.mdp, greedyActions(result.Q))).V;
  EXPECT_LT((policyIteration(world.mdp).V - got).maxCoeff(), .1);
}

TEST(LearnedModel, RefusesWhatMakesNoSense) {
  EXPECT_REX_ERROR(LearnedModel(0, 1), "states of a model: found 0");
  EXPECT_REX_ERROR(LearnedModel(1, 0), "actions of a model: found 0");
  LearnedModel model(2, 1);
  EXPECT_REX_ERROR(model.observe(2, 0, 0, 0), "state of a model: found 2, wanted one of 0 to 1");
  EXPECT_REX_ERROR(model.observe(0, 1, 0, 0), "action of a model: found 1");
  EXPECT_REX_ERROR(model.observe(0, 0, 0, 5), "next state of a model: found 5");
  EXPECT_REX_ERROR(model.observe(0, 0, INFINITY, 0), "reward: found inf");
  EXPECT_REX_ERROR((void)model.visits(0, -1), "action of a model: found -1");
  EXPECT_REX_ERROR((void)model.optimistic(.9, 0, 1), "visits that make a pair known: found 0");
  Rng rng(1);
  EXPECT_REX_ERROR((void)rMax(tMaze(), {.episodes = 0}, rng), "episodes: found 0");
  EXPECT_REX_ERROR((void)rMax(tMaze(), {.maxSteps = 0}, rng), "steps of an episode: found 0");
}

}  // namespace rex::learned_model_test
