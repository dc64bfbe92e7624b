#include "learning/mixture_cloning.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/expect_error.h"

namespace rex::mixture_cloning_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

struct Demonstrations {
  MatrixXd states, actions;
};

double density(const VectorXd& x, const VectorXd& mean, const MatrixXd& covariance) {
  const VectorXd offset = x - mean;
  return std::exp(-offset.dot(covariance.inverse() * offset) / 2) /
         std::sqrt((2 * M_PI * covariance).determinant());
}

// Two experts that answer the same states in different ways.
Demonstrations fromTwoExperts(int n, Rng& rng) {
  Demonstrations seen{MatrixXd(n, 2), MatrixXd(n, 1)};
  for (int i = 0; i < n; ++i) {
    const bool isFirst = rng.uniform() < .3;
    const Vector2d x(rng.normal() + (isFirst ? .5 : 0), .7 * rng.normal());
    seen.states.row(i) = x.transpose();
    seen.actions(i, 0) = isFirst ? 2 * x[0] - x[1] + 3 + .2 * rng.normal() : -x[0] - 1 + .4 * rng.normal();
  }
  return seen;
}

TEST(MixtureCloning, RecoversTheExperts) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Rng rng(seed);
    const Demonstrations seen = fromTwoExperts(3000, rng);
    const MixtureClone clone = cloneMixture(seen.states, seen.actions, rng);
    ASSERT_EQ(clone.status, CloneStatus::kConverged) << clone.message;
    const bool isSwapped = clone.policy.experts[0].weight > .5;
    const MixtureExpert &first = clone.policy.experts[isSwapped ? 1 : 0],
                        &second = clone.policy.experts[isSwapped ? 0 : 1];
    EXPECT_NEAR(first.weight, .3, .03);
    EXPECT_LT((first.gain - Eigen::RowVector2d(2, -1)).norm(), .05);
    EXPECT_LT((second.gain - Eigen::RowVector2d(-1, 0)).norm(), .05);
    EXPECT_NEAR(first.action(Vector2d(0, 0))[0], 3, .05);
    EXPECT_NEAR(second.action(Vector2d(0, 0))[0], -1, .05);
    EXPECT_NEAR(std::sqrt(first.actionCovariance(0, 0)), .2, .02);
    EXPECT_NEAR(std::sqrt(second.actionCovariance(0, 0)), .4, .02);
    EXPECT_LT((first.meanState - Vector2d(.5, 0)).norm(), .1);
  }
}

// The density of an action in a state, times that of the state, in the words of experts.
TEST(MixtureCloning, CountsTheLikelihoodOfItsExperts) {
  Rng rng(4);
  const Demonstrations seen = fromTwoExperts(200, rng);
  const MixtureClone clone = cloneMixture(seen.states, seen.actions, rng, {.experts = 3});
  double sum = 0;
  for (int i = 0; i < 200; ++i) {
    const VectorXd x = seen.states.row(i).transpose(), a = seen.actions.row(i).transpose();
    VectorXd states(3), both(3);
    for (int k = 0; k < 3; ++k) {
      const MixtureExpert& expert = clone.policy.experts[static_cast<std::size_t>(k)];
      states[k] = expert.weight * density(x, expert.meanState, expert.stateCovariance);
      both[k] = states[k] * density(a, expert.action(x), expert.actionCovariance);
    }
    sum += std::log(both.sum());
    EXPECT_LT((clone.policy.probabilities(x) - states / states.sum()).norm(), 1e-9);
  }
  EXPECT_NEAR(clone.logLikelihood, sum, 1e-6);
}

TEST(MixtureCloning, NeverLowersTheLikelihood) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    const Demonstrations seen = fromTwoExperts(100, rng);
    const MixtureClone clone =
        cloneMixture(seen.states, seen.actions, rng,
                     {.experts = 2 + static_cast<int>(seed % 5), .starts = 1, .tolerance = 1e-12});
    ASSERT_GT(clone.history.size(), 5u);
    for (std::size_t i = 1; i < clone.history.size(); ++i)
      EXPECT_GE(clone.history[i], clone.history[i - 1] - 1e-9) << seed << ", " << i;
    EXPECT_GT(clone.history.back(), clone.history.front() + 1);
  }
}

TEST(MixtureCloning, WithOneExpertIsLinearRegression) {
  Rng rng(5);
  const Demonstrations seen = fromTwoExperts(50, rng);
  MatrixXd features(50, 3);
  features << seen.states, VectorXd::Ones(50);
  const LinearClone linear = cloneLinear(features, seen.actions);
  const MixtureClone clone =
      cloneMixture(seen.states, seen.actions, rng, {.experts = 1, .regularisation = 1e-13});
  const MixtureExpert& expert = clone.policy.experts[0];
  EXPECT_LT((expert.gain.transpose() - linear.weights.topRows(2)).norm(), 1e-9);
  EXPECT_NEAR(expert.action(Vector2d(0, 0))[0], linear.weights(2, 0), 1e-9);
  EXPECT_NEAR(std::sqrt(expert.actionCovariance(0, 0)), linear.residual, 1e-9);
  EXPECT_EQ(expert.weight, 1);
}

// A robot drives from x = 0 to 2 and steers by dy/dx around a disc at (1, 0), half of the times on each side.
struct Passage {
  static constexpr double kStep = .05, kRadius = .35;

  // The expert follows an arc of a sine.
  static double steered(double x, double y, double side) {
    return side * (.6 * M_PI / 2 * std::cos(M_PI / 2 * x)) + 2 * (side * .6 * std::sin(M_PI / 2 * x) - y);
  }
  // Whether the disc is passed, if act(x, y) says how to steer.
  template <class Act>
  static bool passes(double y, const Act& act) {
    for (double x = 0; x < 2; x += kStep) {
      if (std::hypot(x - 1, y) < kRadius) return false;
      y += kStep * act(x, y);
    }
    return true;
  }
};

TEST(MixtureCloning, PassesAnObstacleWhereTheMeanCollides) {
  Rng rng(6);
  std::vector<Eigen::Vector3d> steps;
  for (int i = 0; i < 40; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    EXPECT_TRUE(Passage::passes(.05 * rng.normal(), [&](double x, double y) {
      const double action = Passage::steered(x, y, side) + .1 * rng.normal();
      steps.emplace_back(x, y, action);
      return action;
    }));
  }
  MatrixXd states(steps.size(), 2), features(steps.size(), 3), actions(steps.size(), 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    states.row(row) = steps[i].head<2>().transpose();
    features.row(row) << steps[i][0], steps[i][1], 1;
    actions(row, 0) = steps[i][2];
  }
  const LinearClone mean = cloneLinear(features, actions);
  const MixturePolicy policy = cloneMixture(states, actions, rng, {.experts = 4}).policy;
  int passed = 0, meanPassed = 0, left = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const double start = .05 * rng.normal();
    meanPassed += Passage::passes(
        start, [&](double x, double y) { return mean.weights.col(0).dot(Eigen::Vector3d(x, y, 1)); });
    std::optional<int> expert;
    double end = 0;
    passed += Passage::passes(start, [&](double x, double y) {
      expert = policy.expertFor(Vector2d(x, y), expert, rng);
      if (std::abs(x - 1) < .01) end = y;
      return policy.experts[static_cast<std::size_t>(*expert)].action(Vector2d(x, y))[0];
    });
    left += end > 0 ? 1 : 0;
  }
  EXPECT_EQ(passed, 100);
  EXPECT_LE(meanPassed, 5);
  EXPECT_GT(left, 30);
  EXPECT_LT(left, 70);
}

TEST(MixtureCloning, CarriesThroughWhatItBegan) {
  const auto expertAt = [](double x) {
    return MixtureExpert{.5,
                         VectorXd::Constant(1, x),
                         MatrixXd::Identity(1, 1),
                         VectorXd::Zero(1),
                         MatrixXd::Zero(1, 1),
                         MatrixXd::Identity(1, 1)};
  };
  const MixturePolicy policy{{expertAt(-1), expertAt(1)}};
  Rng rng(7);
  int second = 0;
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(policy.expertFor(VectorXd::Zero(1), 1, rng), 1);
    second += policy.expertFor(VectorXd::Constant(1, .5), {}, rng);
    EXPECT_EQ(policy.expertFor(VectorXd::Constant(1, 20), 0, rng), 1);
  }
  EXPECT_NEAR(second / 1000., 1 / (1 + std::exp(-1)), .06);  // log odds of 2 x
}

TEST(MixtureCloning, RefusesWrongInput) {
  Rng rng(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_REX_ERROR(cloneMixture(I.topRows(1), I.topRows(1), rng, {.experts = 1}),
                   "demonstrations: found 1, wanted at least 2");
  EXPECT_REX_ERROR(cloneMixture(I, I, rng, {.experts = 4}), "demonstrations: found 3, wanted at least 4");
  EXPECT_REX_ERROR(cloneMixture(I, I.topRows(2), rng), "actions of the demonstrations");
  EXPECT_REX_ERROR(cloneMixture(MatrixXd(3, 0), I, rng), "states of the demonstrations: found none");
  EXPECT_REX_ERROR(cloneMixture(I, MatrixXd(3, 0), rng), "actions of the demonstrations: found none");
  EXPECT_REX_ERROR(cloneMixture(nan * I, I, rng),
                   "states of demonstration 0: found entries that are not finite");
  EXPECT_REX_ERROR(cloneMixture(I, nan * I, rng),
                   "actions of demonstration 0: found entries that are not finite");
  EXPECT_REX_ERROR(cloneMixture(MatrixXd::Ones(3, 1), I, rng),
                   "coordinate 0 of the states: found the same number in all demonstrations");
  EXPECT_REX_ERROR(cloneMixture(I, MatrixXd::Ones(3, 2), rng), "coordinate 0 of the actions: found the same");
  EXPECT_REX_ERROR(cloneMixture(I, I, rng, {.experts = 0}), "experts: found 0");
  EXPECT_REX_ERROR(cloneMixture(I, I, rng, {.starts = 0}), "starts of expectation maximisation: found 0");
  EXPECT_REX_ERROR(cloneMixture(I, I, rng, {.maxIterations = 0}), "iterations of expectation maximisation");
  EXPECT_REX_ERROR(cloneMixture(I, I, rng, {.tolerance = 0}), "tolerance of expectation maximisation");
  EXPECT_REX_ERROR(cloneMixture(I, I, rng, {.regularisation = 0}), "regularisation of covariances");
  Rng more(2);
  const Demonstrations seen = fromTwoExperts(60, more);
  const MixtureClone clone = cloneMixture(seen.states, seen.actions, rng, {.maxIterations = 1});
  EXPECT_EQ(clone.status, CloneStatus::kNotConverged);
  EXPECT_THAT(clone.message, testing::HasSubstr("not converged after 1 iterations"));
  EXPECT_REX_ERROR(clone.policy.probabilities(VectorXd::Ones(3)), "state of an expert");
  EXPECT_REX_ERROR(clone.policy.experts[0].action(VectorXd::Ones(3)), "state of an expert");
  EXPECT_REX_ERROR(clone.policy.expertFor(Vector2d(0, 0), 2, rng),
                   "previous expert: found 2, wanted one of 0 to 1");
}

}  // namespace rex::mixture_cloning_test
