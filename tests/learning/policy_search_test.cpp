#include "learning/policy_search.h"

#include <gtest/gtest.h>

#include "control/riccati.h"
#include "learning/lq_task.h"
#include "optim/search_result.h"  // one program may search both ways
#include "support/expect_error.h"

namespace rex::policy_search_test {

// Of a long horizon, the optimum is the regulator of the discounted problem.
TEST(PolicySearch, NearsTheRegulator) {
  LqTask task;
  task.horizon = 60;
  task.bonus = 10;
  const double root = std::sqrt(task.discount);
  const Eigen::MatrixXd R = Eigen::MatrixXd::Constant(1, 1, task.R);
  const Eigen::Vector2d best = -solveDare(root * task.A, root * task.B, task.Q, R).K.transpose();
  const double optimum = task.expectedReturn(best, Eigen::Matrix2d::Zero());
  const double start = task.expectedReturn(Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero());
  const auto remaining = [&](double noise, const PolicySearchOptions& options) {
    Rng rng(1);
    const LinearGaussianPolicy policy{Eigen::Vector2d::Zero(), noise * Eigen::Matrix2d::Identity()};
    const PolicySearchResult result = improvedPolicy(task.rollouts(), policy, options, rng);
    EXPECT_EQ(result.status, PolicySearchStatus::kFinished) << result.message;
    EXPECT_EQ(static_cast<int>(result.returns.size()), options.iterations);
    const double found = task.expectedReturn(result.policy.beta, Eigen::Matrix2d::Zero());
    return (optimum - found) / (optimum - start);
  };
  PolicySearchOptions options{
      .method = SearchMethod::kReinforce, .iterations = 150, .discount = task.discount};
  EXPECT_LT(remaining(.02, options), .1);
  options.rate = 20;  // times the small covariance, which the inverse Fisher metric is like
  options.method = SearchMethod::kNaturalGradient;
  EXPECT_LT(remaining(.02, options), .1);
  options.method = SearchMethod::kEpisodicNaturalGradient;
  EXPECT_LT(remaining(.02, options), .1);
}

// Single shots at a target that depends on three features in any mixture: PoWER, as corrected, finds it.
TEST(PolicySearch, PowerHitsTheTarget) {
  const Eigen::Vector3d target(1.5, -2, .7);
  ControlTask task;
  task.horizon = 1;
  task.start = [](Rng& rng) {
    const Eigen::VectorXd x = rng.normalVector(3);
    return Eigen::VectorXd(Eigen::Vector3d(1, 1 + .5 * x[0], x[1] - x[0]));
  };
  task.features = [](const Eigen::VectorXd& x) { return x; };
  task.step = [&](const Eigen::VectorXd& x, double a, Rng&) {
    return ControlTask::Outcome{x, std::exp(-.3 * std::pow(a - target.dot(x), 2)), false};
  };
  Rng rng(4);
  const LinearGaussianPolicy start{Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  const PolicySearchOptions options{
      .method = SearchMethod::kPower, .iterations = 60, .episodes = 300, .longestStep = 1, .noiseDecay = .95};
  const PolicySearchResult result = improvedPolicy(rolloutSource(task), start, options, rng);
  EXPECT_EQ(result.status, PolicySearchStatus::kFinished) << result.message;
  EXPECT_LT((result.policy.beta - target).norm(), .2);
  EXPECT_GT(result.returns.back(), .9);
  EXPECT_LT(result.returns.front(), .6);
}

TEST(PolicySearch, SaysWhyItStops) {
  Rng rng(2);
  const LinearGaussianPolicy start{Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1)};
  const auto rewarding = [](double reward) -> RolloutSource {
    return [reward](const LinearGaussianPolicy&, int count, Rng&) {
      const Episode one{Eigen::MatrixXd::Ones(1, 1), Eigen::MatrixXd::Zero(1, 1),
                        Eigen::VectorXd::Constant(1, reward)};
      return std::vector<Episode>(static_cast<std::size_t>(count), one);
    };
  };
  const PolicySearchResult stuck = improvedPolicy(rewarding(1), start, {}, rng);
  EXPECT_EQ(stuck.status, PolicySearchStatus::kStuck);
  EXPECT_EQ(stuck.message, "no direction promises a higher return after 0 iterations");
  EXPECT_EQ(improvedPolicy(rewarding(0), start, {.method = SearchMethod::kPower}, rng).status,
            PolicySearchStatus::kStuck);
  const PolicySearchResult diverged = improvedPolicy(rewarding(INFINITY), start, {}, rng);
  EXPECT_EQ(diverged.status, PolicySearchStatus::kDiverged);
  EXPECT_EQ(diverged.message, "returns are no longer finite after 0 iterations");
}

TEST(PolicySearch, KeepsTheBestAndBoundsItsSteps) {
  LqTask task;
  Rng rng(3), same(3);
  const LinearGaussianPolicy start{Eigen::Vector2d(-.2, -.2), .01 * Eigen::Matrix2d::Identity()};
  const PolicySearchOptions options{.iterations = 10, .episodes = 5, .longestStep = 1e-3, .noiseDecay = .5};
  const PolicySearchResult result = improvedPolicy(task.rollouts(), start, options, rng);
  EXPECT_LE((result.policy.beta - start.beta).norm(), 1e-2 + 1e-12);
  EXPECT_NEAR(result.policy.Sigma(0, 0), .01 / 1024, 1e-15);
  EXPECT_EQ(improvedPolicy(task.rollouts(), start, options, same).policy.beta, result.policy.beta);
  // The best one was among them: its noise tells when.
  const auto place = std::max_element(result.returns.begin(), result.returns.end()) - result.returns.begin();
  EXPECT_NEAR(result.best.Sigma(0, 0), .01 * std::pow(.5, static_cast<double>(place)), 1e-15);
}

TEST(PolicySearch, RefusesWrongOptions) {
  Rng rng(1);
  const LinearGaussianPolicy start{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity()};
  const auto refuses = [&](const PolicySearchOptions& options, const char* text) {
    EXPECT_REX_ERROR(improvedPolicy(LqTask().rollouts(), start, options, rng), text);
  };
  refuses({.iterations = 0}, "iterations of the search: found 0, wanted at least 1");
  refuses({.episodes = 1}, "episodes of an iteration: found 1, wanted at least 2");
  refuses({.rate = 0}, "rate: found 0, wanted a positive, finite number");
  refuses({.longestStep = -1}, "longestStep: found -1, wanted a positive number, or infinity");
  refuses({.noiseDecay = 1.1}, "noiseDecay: found 1.1, wanted a number above 0, up to 1");
  refuses({.discount = 2}, "discount: found 2");
  EXPECT_REX_ERROR(improvedPolicy(LqTask().rollouts(), {}, {}, rng), "policy: found no parameter");
}

}  // namespace rex::policy_search_test
