#include "learning/behavioural_cloning.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "learning/lq_task.h"
#include "support/expect_error.h"

namespace rex::behavioural_cloning_test {

Eigen::MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

// From episodes with noise: each action is phi^T (beta + epsilon).
TEST(BehaviouralCloning, RecoversALinearPolicy) {
  const LqTask task;
  const Eigen::Vector2d beta(-.3, -.2);
  Rng rng(1);
  const auto demonstrations = task.rollouts()({beta, .01 * Eigen::Matrix2d::Identity()}, 200, rng);
  Eigen::MatrixXd features(200 * task.horizon, 2);
  Eigen::VectorXd actions(200 * task.horizon), exact(200 * task.horizon);
  for (int i = 0; i < 200; ++i)
    for (int t = 0; t < task.horizon; ++t) {
      const auto& episode = demonstrations[static_cast<std::size_t>(i)];
      const int row = i * task.horizon + t;
      features.row(row) = episode.features.col(t).transpose();
      actions[row] = episode.features.col(t).dot(beta + episode.noise.col(t));
      exact[row] = episode.features.col(t).dot(beta);
    }
  const LinearClone clone = cloneLinear(features, actions);
  EXPECT_LT((clone.weights - beta).norm(), .01);
  EXPECT_EQ(clone.rank, 2);
  EXPECT_GT(clone.residual, .01);
  const LinearClone same = cloneLinear(features, exact);
  EXPECT_LT((same.weights - beta).norm(), 1e-13);
  EXPECT_LT(same.residual, 1e-13);
  EXPECT_NEAR(task.expectedReturn(Eigen::Vector2d(clone.weights), Eigen::Matrix2d::Zero()),
              task.expectedReturn(beta, Eigen::Matrix2d::Zero()), .02);
}

TEST(BehaviouralCloning, SolvesTheNormalEquations) {
  Rng rng(2);
  const Eigen::MatrixXd X = randomMatrix(30, 4, rng), Y = randomMatrix(30, 2, rng);
  for (const double ridge : {0., 1e-3, 10.}) {
    const Eigen::MatrixXd normal = X.transpose() * X + ridge * Eigen::MatrixXd::Identity(4, 4);
    EXPECT_LT((cloneLinear(X, Y, ridge).weights - normal.ldlt().solve(X.transpose() * Y)).norm(), 1e-12);
  }
  // Of equal features each takes half.
  Eigen::MatrixXd twice(30, 2);
  twice << X.col(0), X.col(0);
  const LinearClone clone = cloneLinear(twice, 3 * X.col(0));
  EXPECT_EQ(clone.rank, 1);
  EXPECT_LT((clone.weights - Eigen::Vector2d(1.5, 1.5)).norm(), 1e-13);
}

double softmaxLoss(const Eigen::MatrixXd& X, const std::vector<int>& actions, const Eigen::MatrixXd& W,
                   double ridge) {
  double sum = 0;
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    const Eigen::RowVectorXd scores = X.row(i) * W;
    sum += std::log(scores.array().exp().sum()) - scores[actions[static_cast<std::size_t>(i)]];
  }
  return sum / static_cast<double>(X.rows()) + .5 * ridge * W.squaredNorm();
}

TEST(BehaviouralCloning, SoftmaxStopsAtAMinimum) {
  Rng rng(3);
  const Eigen::MatrixXd X = 2 * randomMatrix(60, 3, rng);
  std::vector<int> actions;
  for (int i = 0; i < 60; ++i) actions.push_back(rng.index(4));
  for (const double ridge : {1e-4, .1}) {
    const SoftmaxClone clone = cloneSoftmax(X, actions, 4, ridge);
    ASSERT_EQ(clone.status, CloneStatus::kConverged) << clone.message;
    EXPECT_NEAR(clone.loss, softmaxLoss(X, actions, clone.policy.weights, ridge), 1e-12);
    const auto loss = [&](const Eigen::VectorXd& w) {
      return Eigen::VectorXd::Constant(1, softmaxLoss(X, actions, w.reshaped(3, 4), ridge));
    };
    EXPECT_LT(numericJacobian(loss, clone.policy.weights.reshaped()).norm(), 1e-8);
    EXPECT_LT(clone.residual, 1e-9);
  }
}

// With one constant feature and hardly a ridge, probabilities are frequencies.
TEST(BehaviouralCloning, SoftmaxCountsActions) {
  const SoftmaxClone clone =
      cloneSoftmax(Eigen::MatrixXd::Ones(10, 1), {0, 0, 0, 0, 0, 1, 1, 1, 2, 2}, 3, 1e-9);
  ASSERT_EQ(clone.status, CloneStatus::kConverged) << clone.message;
  const Eigen::VectorXd P = clone.policy.probabilities(Eigen::VectorXd::Ones(1));
  EXPECT_LT((P - Eigen::Vector3d(.5, .3, .2)).norm(), 1e-7);
  const Eigen::VectorXd sure = clone.policy.probabilities(Eigen::VectorXd::Constant(1, 1e6));
  EXPECT_LT((sure - Eigen::Vector3d(1, 0, 0)).norm(), 1e-300);
}

TEST(BehaviouralCloning, SoftmaxRecoversChoices) {
  Rng rng(4);
  const Eigen::MatrixXd W = 2 * randomMatrix(3, 3, rng), X = randomMatrix(20000, 3, rng);
  std::vector<int> actions;
  for (int i = 0; i < X.rows(); ++i) {
    const Eigen::VectorXd P = SoftmaxPolicy{W}.probabilities(X.row(i).transpose());
    const double u = rng.uniform();
    actions.push_back(u < P[0] ? 0 : u < P[0] + P[1] ? 1 : 2);
  }
  const SoftmaxClone clone = cloneSoftmax(X, actions, 3, 1e-6);
  ASSERT_EQ(clone.status, CloneStatus::kConverged) << clone.message;
  for (int i = 0; i < 100; ++i)
    EXPECT_LT((clone.policy.probabilities(X.row(i).transpose()) -
               SoftmaxPolicy{W}.probabilities(X.row(i).transpose()))
                  .cwiseAbs()
                  .maxCoeff(),
              .05);
}

TEST(BehaviouralCloning, SaysWhenItIsNotThere) {
  // Told apart at once, and hardly held back: the weights want to be large.
  const Eigen::MatrixXd X = Eigen::Vector4d(-2, -1, 1, 2);
  const SoftmaxClone clone = cloneSoftmax(X, {0, 0, 1, 1}, 2, 1e-9, 2);
  EXPECT_EQ(clone.status, CloneStatus::kNotConverged);
  EXPECT_EQ(clone.iterations, 2);
  EXPECT_THAT(clone.message, testing::HasSubstr("not converged after 2 iterations"));
  EXPECT_EQ(cloneSoftmax(X, {0, 0, 1, 1}, 2, 1e-9).status, CloneStatus::kConverged);
}

TEST(BehaviouralCloning, RefusesWrongInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
  EXPECT_REX_ERROR(cloneLinear(Eigen::MatrixXd(0, 2), I), "features of the demonstrations: found 0 x 2");
  EXPECT_REX_ERROR(cloneLinear(Eigen::Matrix2d{{1, 0}, {nan, 1}}, I),
                   "features of demonstration 1: found entries that are not finite");
  EXPECT_REX_ERROR(cloneLinear(I, Eigen::Vector3d::Zero()), "actions of the demonstrations");
  EXPECT_REX_ERROR(cloneLinear(I, Eigen::MatrixXd(2, 0)), "actions of the demonstrations: found none");
  EXPECT_REX_ERROR(cloneLinear(I, Eigen::Vector2d(1, nan)),
                   "action of demonstration 1: found entries that are not finite");
  EXPECT_REX_ERROR(cloneLinear(I, I, -1), "ridge: found -1, wanted a finite number, 0 or more");
  EXPECT_REX_ERROR(cloneSoftmax(I, {0}, 2), "actions of the demonstrations");
  EXPECT_REX_ERROR(cloneSoftmax(I, {0, 0}, 1), "actions: found 1, wanted at least 2");
  EXPECT_REX_ERROR(cloneSoftmax(I, {0, 2}, 2), "action of demonstration 1: found 2, wanted one of 0 to 1");
  EXPECT_REX_ERROR(cloneSoftmax(I, {0, 1}, 2, 0), "ridge: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(SoftmaxPolicy{I}.probabilities(Eigen::Vector3d::Zero()), "features");
}

// Features of another unit, with the ridge to go with it, are the same problem.
TEST(BehaviouralCloning, SoftmaxDoesNotMindUnits) {
  Rng rng(5);
  const Eigen::MatrixXd X = randomMatrix(60, 3, rng);
  std::vector<int> actions;
  for (int i = 0; i < 60; ++i) actions.push_back(X(i, 0) + rng.normal() > 0 ? 1 : 0);
  const Eigen::MatrixXd weights = cloneSoftmax(X, actions, 2, 1e-2).policy.weights;
  for (const double unit : {1e-12, 1e-5, 1e6}) {
    const SoftmaxClone clone = cloneSoftmax(unit * X, actions, 2, 1e-2 * unit * unit);
    EXPECT_EQ(clone.status, CloneStatus::kConverged) << clone.message;
    EXPECT_LT((unit * clone.policy.weights - weights).norm(), 1e-7 * weights.norm()) << unit;
  }
}

}  // namespace rex::behavioural_cloning_test
