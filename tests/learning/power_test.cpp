#include <cmath>

#include <gtest/gtest.h>

#include "learning/lq_task.h"
#include "learning/policy_search.h"
#include "support/expect_error.h"

namespace rex::power_test {

// With one feature the slide's ratio is right: sum epsilon Q / sum Q.
TEST(Power, IsTheRatioForOneFeature) {
  const LinearGaussianPolicy policy{Eigen::VectorXd::Constant(1, .5), Eigen::MatrixXd::Constant(1, 1, 2)};
  const Episode one{Eigen::RowVector2d(1, 3), Eigen::RowVector2d(.5, -1), Eigen::Vector2d(2, 4)};
  const Episode two{Eigen::MatrixXd::Constant(1, 1, -2), Eigen::MatrixXd::Constant(1, 1, .2),
                    Eigen::VectorXd::Constant(1, 1)};
  const PowerStep step = powerStep(policy, {one, two}, .5);
  EXPECT_EQ(step.status, PowerStatus::kMoved);
  EXPECT_NEAR(step.beta[0], .5 + (.5 * 4 - 1 * 4 + .2 * 1) / (4 + 4 + 1), 1e-15);
}

// What the step maximises: sum_t Q log pi(a | s; beta), the bound of Kober and Peters; a weighted least
// squares problem of its own.
TEST(Power, MaximisesTheWeightedLikelihood) {
  Rng rng(2);
  const Eigen::Matrix2d Sigma{{.5, .2}, {.2, .3}};
  const LinearGaussianPolicy policy{Eigen::Vector2d(1, -1), Sigma};
  LqTask task;
  task.bonus = 100;
  const std::vector<Episode> episodes = task.rollouts()(policy, 30, rng);
  const auto bound = [&](const Eigen::Vector2d& beta) {
    double sum = 0;
    for (const Episode& e : episodes) {
      const Eigen::VectorXd Q = returnsToGo(e.rewards, 1);
      for (Eigen::Index t = 0; t < Q.size(); ++t) {
        const Eigen::Vector2d phi = e.features.col(t);
        sum -= Q[t] * std::pow(phi.dot(policy.beta + e.noise.col(t) - beta), 2) / phi.dot(Sigma * phi);
      }
    }
    return sum;
  };
  const PowerStep step = powerStep(policy, episodes, 1);
  ASSERT_EQ(step.status, PowerStatus::kMoved);
  for (const double size : {1e-3, .1, 10.})
    for (const Eigen::Vector2d& direction : {Eigen::Vector2d(1, 0), {0, 1}, {1, 1}, {1, -1}})
      for (const double sign : {-1., 1.})
        EXPECT_GT(bound(step.beta), bound(step.beta + sign * size * direction));
}

TEST(Power, RaisesTheExpectedReturn) {
  LqTask task;
  task.bonus = 20;  // so that returns are positive
  Rng rng(3);
  LinearGaussianPolicy policy{Eigen::Vector2d::Zero(), .2 * Eigen::Matrix2d::Identity()};
  double before = task.expectedReturn(policy.beta, policy.Sigma);
  for (int i = 0; i < 5; ++i) {
    const PowerStep step = powerStep(policy, task.rollouts()(policy, 10000, rng), task.discount);
    ASSERT_EQ(step.status, PowerStatus::kMoved);
    policy.beta = step.beta;
    const double after = task.expectedReturn(policy.beta, policy.Sigma);
    EXPECT_GT(after, before);
    before = after;
  }
}

TEST(Power, SaysWhenNothingIsLearned) {
  const LinearGaussianPolicy policy{Eigen::Vector2d(1, 2), Eigen::Matrix2d::Identity()};
  Episode episode{Eigen::MatrixXd::Random(2, 5), Eigen::MatrixXd::Ones(2, 5), Eigen::VectorXd::Zero(5)};
  EXPECT_EQ(powerStep(policy, {episode}, 1).status, PowerStatus::kNoReturn);
  EXPECT_EQ(powerStep(policy, {episode}, 1).beta, policy.beta);
  episode.rewards.setOnes();
  EXPECT_EQ(powerStep(policy, {episode}, 1).status, PowerStatus::kMoved);
  episode.features.row(1) = episode.features.row(0);
  EXPECT_EQ(powerStep(policy, {episode}, 1).message,
            "no step: the returns are all zero, or the features are linearly dependent");
  episode.features.setZero();
  EXPECT_EQ(powerStep(policy, {episode}, 1).status, PowerStatus::kNoReturn);
}

TEST(Power, RefusesWrongInput) {
  LinearGaussianPolicy policy{Eigen::Vector2d(1, 2), Eigen::Matrix2d::Identity()};
  Episode episode{Eigen::MatrixXd::Ones(2, 3), Eigen::MatrixXd::Ones(2, 3), Eigen::Vector3d(1, 1, -.5)};
  EXPECT_REX_ERROR(powerStep(policy, {episode}, 1),
                   "return of episode 0 from step 2: found -0.5, wanted 0 or more, for PoWER");
  EXPECT_REX_ERROR(powerStep(policy, {}, 1), "episodes: found none");
  EXPECT_REX_ERROR(powerStep(policy, {episode}, 2), "discount: found 2");
  policy.Sigma(1, 1) = 0;
  EXPECT_REX_ERROR(powerStep(policy, {episode}, 1), "Sigma of the policy: found a direction without noise");
}

}  // namespace rex::power_test
