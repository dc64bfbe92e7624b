#include <limits>

#include <gtest/gtest.h>

#include "learning/dynamic_programming.h"
#include "learning/mazes.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::policy_values_test {

// The sums over time themselves, until nothing is left of the discount.
TEST(PolicyValues, AreDiscountedSums) {
  Rng rng(1);
  for (const double discount : {0., .3, .9}) {
    const Mdp mdp = randomMdp(12, 3, discount, rng, 2);
    const Eigen::MatrixXd policy = randomPolicy(mdp, rng);
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(12, 12);
    for (int a = 0; a < 3; ++a)
      P += policy.col(a).asDiagonal() * Eigen::MatrixXd(mdp.transitions[static_cast<std::size_t>(a)]);
    const Eigen::VectorXd r = mdp.rewards.cwiseProduct(policy).rowwise().sum();
    Eigen::VectorXd start = rng.uniformVector(12, 0, 1);
    start /= start.sum();
    Eigen::VectorXd V = Eigen::VectorXd::Zero(12), visits = V, now = start;
    Eigen::VectorXd later = r;
    for (int t = 0; t < 400; ++t) {
      V += later;
      visits += now;
      later = discount * P * later;
      now = discount * P.transpose() * now;
    }
    const PolicyValues values = policyValues(mdp, policy);
    ASSERT_EQ(values.status, MdpStatus::kSolved) << values.message;
    EXPECT_LT((values.V - V).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT(values.residual, 1e-14);
    EXPECT_LT((discountedVisits(mdp, policy, start) - visits).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(PolicyValues, RefuseWrongInput) {
  Mdp mdp = tMaze();
  EXPECT_REX_ERROR(policyValues(mdp, Eigen::MatrixXd::Zero(7, 2)), "policy in state 0: found probabilities");
  const Eigen::MatrixXd policy = uniformPolicy(mdp);
  EXPECT_REX_ERROR(discountedVisits(mdp, policy, Eigen::VectorXd::Zero(3)), "start distribution");
  Eigen::VectorXd start = Eigen::VectorXd::Zero(7);
  EXPECT_REX_ERROR(discountedVisits(mdp, policy, start), "start distribution: found probabilities that sum");
  start[2] = 1 + 1e-8;
  EXPECT_REX_ERROR(discountedVisits(mdp, policy, start), "found probabilities that sum to 1.00000001");
  start[4] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REX_ERROR(discountedVisits(mdp, policy, start), "start in state 4: found nan, wanted a probability");
  mdp.discount = -1;
  EXPECT_REX_ERROR(policyValues(mdp, policy), "discount: found -1");
}

// It ends, but so rarely that a double cannot tell.
TEST(PolicyValues, SayWhenTheSystemIsSingular) {
  Mdp mdp;
  mdp.discount = 1;
  mdp.terminal = {false, true};
  mdp.rewards = Eigen::Vector2d::Ones();
  mdp.transitions.assign(1, TransitionMatrix(2, 2));
  mdp.transitions[0].insert(0, 0) = 1;
  mdp.transitions[0].insert(0, 1) = 1e-20;
  const Eigen::MatrixXd policy = uniformPolicy(mdp);
  const PolicyValues values = policyValues(mdp, policy);
  EXPECT_EQ(values.status, MdpStatus::kNotConverged);
  EXPECT_EQ(values.V.size(), 0);
  EXPECT_THAT(values.message, testing::HasSubstr("singular in double precision"));
  EXPECT_REX_ERROR(discountedVisits(mdp, policy, Eigen::Vector2d(1, 0)), "singular in double precision");
  EXPECT_EQ(policyIteration(mdp).status, MdpStatus::kNotConverged);
}

}  // namespace rex::policy_values_test
