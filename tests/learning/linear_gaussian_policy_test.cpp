#include "learning/linear_gaussian_policy.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "learning/lq_task.h"
#include "support/expect_error.h"

namespace rex::linear_gaussian_policy_test {

TEST(LinearGaussianPolicy, NoiseHasItsCovariance) {
  const Eigen::Matrix3d Sigma{{2, .3, 0}, {.3, 1, 0}, {0, 0, 0}};
  const Eigen::MatrixXd L = noiseRoot({Eigen::Vector3d::Zero(), Sigma});
  EXPECT_LT((L * L.transpose() - Sigma).norm(), 1e-14);
  ControlTask task;
  task.horizon = 20000;
  task.start = [](Rng&) { return Eigen::VectorXd::Zero(3); };
  task.features = [](const Eigen::VectorXd& x) { return x; };
  task.step = [](const Eigen::VectorXd& x, double, Rng&) { return ControlTask::Outcome{x, 0, false}; };
  Rng rng(1);
  const Episode episode = rolloutSource(task)({Eigen::Vector3d::Zero(), Sigma}, 1, rng).front();
  EXPECT_LT((episode.noise * episode.noise.transpose() / 20000 - Sigma).cwiseAbs().maxCoeff(), .1);
}

TEST(LinearGaussianPolicy, RolloutsTellWhatHappened) {
  // The state counts the steps; the action pays; after three steps it fails.
  ControlTask task;
  task.horizon = 10;
  task.start = [](Rng&) { return Eigen::VectorXd::Ones(1); };
  task.features = [](const Eigen::VectorXd& x) { return x; };
  task.step = [](const Eigen::VectorXd& x, double a, Rng&) {
    return ControlTask::Outcome{x.array() + 1, a, x[0] >= 3};
  };
  Rng rng(2), same(2);
  const LinearGaussianPolicy policy{Eigen::VectorXd::Constant(1, .5), Eigen::MatrixXd::Constant(1, 1, .01)};
  const std::vector<Episode> episodes = rolloutSource(task)(policy, 4, rng);
  ASSERT_EQ(episodes.size(), 4u);
  for (const Episode& episode : episodes) {
    EXPECT_EQ(episode.features, Eigen::RowVector3d(1, 2, 3));
    EXPECT_EQ(episode.rewards.transpose(),
              episode.features.cwiseProduct((episode.noise.array() + .5).matrix()));
  }
  EXPECT_NE(episodes[0].noise, episodes[1].noise);
  EXPECT_EQ(rolloutSource(task)(policy, 4, same)[3].noise, episodes[3].noise);
}

TEST(LinearGaussianPolicy, SumsReturns) {
  EXPECT_EQ(returnsToGo(Eigen::Vector3d(1, 2, 4), .5), Eigen::Vector3d(3, 4, 4));
  const Episode one{Eigen::MatrixXd::Zero(1, 2), Eigen::MatrixXd::Zero(1, 2), Eigen::Vector2d(1, 2)};
  const Episode two{Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Ones(1)};
  EXPECT_EQ(meanReturn({one, two}, .5), 1.5);
}

TEST(LinearGaussianPolicy, RefusesWrongInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector2d beta(1, 2);
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  EXPECT_REX_ERROR(requirePolicy({}), "policy: found no parameter");
  EXPECT_REX_ERROR(requirePolicy({Eigen::Vector2d(1, nan), I}), "beta of the policy: number 1: found nan");
  EXPECT_REX_ERROR(requirePolicy({beta, Eigen::MatrixXd::Zero(3, 2)}), "rows of Sigma");
  EXPECT_REX_ERROR(requirePolicy({beta, Eigen::MatrixXd::Zero(2, 3)}), "columns of Sigma");
  EXPECT_REX_ERROR(requirePolicy({beta, nan * I}), "Sigma of the policy: number 0: found nan");
  EXPECT_REX_ERROR(requirePolicy({beta, Eigen::Matrix2d{{1, .1}, {0, 1}}}), "a matrix that is not symmetric");
  EXPECT_REX_ERROR(requirePolicy({beta, -I}), "found the eigenvalue -1, wanted none below zero");
  EXPECT_REX_ERROR(meanReturn({}, 1), "episodes: found none");
  EXPECT_REX_ERROR(rolloutSource({}),
                   "task: found a function that is empty, wanted start, features and step");
  ControlTask task;
  task.start = [](Rng&) { return Eigen::VectorXd::Ones(1); };
  task.features = [](const Eigen::VectorXd& x) { return x; };
  task.step = [](const Eigen::VectorXd& x, double, Rng&) { return ControlTask::Outcome{x, 0, false}; };
  Rng rng(1);
  EXPECT_REX_ERROR(rolloutSource(task)({beta, I}, 1, rng), "features of the state");
  task.horizon = 0;
  EXPECT_REX_ERROR(rolloutSource(task), "horizon of the task: found 0, wanted at least 1");
}

TEST(LinearGaussianPolicy, TellsTheVarianceOfActionsFromRounding) {
  Rng rng(3);
  for (int round = 0; round < 100; ++round) {
    const Eigen::Vector3d v = rng.normalVector(3), other = rng.normalVector(3);
    const LinearGaussianPolicy policy{Eigen::Vector3d::Zero(), v * v.transpose()};
    EXPECT_EQ(actionVariance(policy, v.cross(other)), 0);  // the only noise is along v
    EXPECT_NEAR(actionVariance(policy, other), std::pow(v.dot(other), 2), 1e-13);
    // Units that differ much are no reason to lose what there is.
    const Eigen::DiagonalMatrix<double, 3> units(1e-9, 1, 1e9);
    EXPECT_NEAR(actionVariance({policy.beta, units * policy.Sigma * units}, units.inverse() * other),
                std::pow(v.dot(other), 2), 1e-12);
  }
}

}  // namespace rex::linear_gaussian_policy_test
