#include "learning/dynamic_programming.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "learning/mazes.h"
#include "learning/random_mdp.h"
#include "support/expect_error.h"

namespace rex::dynamic_programming_test {

double largest(const Eigen::MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

// The best of all deterministic policies, each evaluated by a dense system of its own.
Eigen::VectorXd bestOfAllPolicies(const Mdp& mdp) {
  const int n = mdp.states(), m = mdp.actions();
  Eigen::VectorXd best = Eigen::VectorXd::Constant(n, -1e300);
  for (int code = 0; code < std::lround(std::pow(m, n)); ++code) {
    Eigen::MatrixXd P(n, n);
    Eigen::VectorXd r(n);
    for (int s = 0, rest = code; s < n; ++s, rest /= m) {
      P.row(s) = Eigen::MatrixXd(mdp.transitions[static_cast<std::size_t>(rest % m)]).row(s);
      r[s] = mdp.rewards(s, rest % m);
    }
    const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n) - mdp.discount * P;
    best = best.cwiseMax(M.fullPivLu().solve(r));
  }
  return best;
}

TEST(DynamicProgramming, FindsTheBestOfAllPolicies) {
  Rng rng(7);
  for (int round = 0; round < 20; ++round) {
    const Mdp mdp = randomMdp(2 + rng.index(5), 2 + rng.index(2), rng.uniform(0, .95), rng, round % 2);
    const Eigen::VectorXd best = bestOfAllPolicies(mdp);
    const MdpSolution values = valueIteration(mdp), policies = policyIteration(mdp);
    ASSERT_EQ(values.status, MdpStatus::kSolved) << values.message;
    ASSERT_EQ(policies.status, MdpStatus::kSolved) << policies.message;
    EXPECT_LT(largest(values.V - best), values.errorBound);
    EXPECT_LT(largest(policies.V - best), policies.errorBound);
    EXPECT_LT(policies.errorBound, 1e-11);
    EXPECT_EQ(values.actions, policies.actions);
  }
}

// Without discount, in processes that always may end.
TEST(DynamicProgramming, FindsTheBestWithoutDiscount) {
  Rng rng(8);
  for (int round = 0; round < 20; ++round) {
    const Mdp mdp = randomMdp(6, 2, 1, rng, 2);
    const MdpSolution solution = policyIteration(mdp);
    ASSERT_EQ(solution.status, MdpStatus::kSolved) << solution.message;
    EXPECT_LT(largest(solution.V - bestOfAllPolicies(mdp)), 1e-11);
  }
}

// The dual of the linear programme: visits of the optimal policy are feasible and earn what V* promises, so
// that neither can be better.
TEST(DynamicProgramming, AgreesWithTheDualProgramme) {
  Rng rng(9);
  const Mdp mdp = randomMdp(300, 4, .97, rng, 5);
  const MdpSolution solution = policyIteration(mdp);
  ASSERT_EQ(solution.status, MdpStatus::kSolved);
  EXPECT_GT(solution.iterations, 2);
  EXPECT_EQ(solution.history.size() + 1, static_cast<std::size_t>(solution.iterations));
  const Eigen::VectorXd start = Eigen::VectorXd::Constant(300, 1. / 300);
  const Eigen::MatrixXd policy = deterministicPolicy(mdp, solution.actions);
  const Eigen::VectorXd visits = discountedVisits(mdp, policy, start);
  EXPECT_GE(visits.minCoeff(), 0);
  EXPECT_NEAR(visits.dot(mdp.rewards.cwiseProduct(policy).rowwise().sum()), start.dot(solution.V), 1e-10);
  EXPECT_LT((actionValues(mdp, solution.V).colwise() - solution.V).maxCoeff(), 1e-11);
  const MdpSolution values = valueIteration(mdp);
  EXPECT_EQ(values.status, MdpStatus::kSolved);
  EXPECT_LT(largest(values.V - solution.V), values.errorBound);
}

TEST(DynamicProgramming, BoundsItsError) {
  Rng rng(10);
  const Mdp mdp = randomMdp(20, 3, .9, rng);
  const Eigen::VectorXd V = policyIteration(mdp).V;
  for (const int steps : {1, 2, 5, 20, 50}) {
    const MdpSolution solution = valueIteration(mdp, {.maxIterations = steps});
    EXPECT_EQ(solution.status, MdpStatus::kNotConverged);
    EXPECT_EQ(solution.iterations, steps);
    EXPECT_EQ(solution.history.size(), static_cast<std::size_t>(steps));
    EXPECT_LT(largest(solution.V - V), solution.errorBound);
    EXPECT_THAT(solution.message, testing::HasSubstr("not converged"));
  }
  // What doubles cannot tell is not claimed.
  const MdpSolution finest = valueIteration(mdp, {.tolerance = 1e-300});
  EXPECT_EQ(finest.status, MdpStatus::kNotConverged);
  EXPECT_LT(largest(finest.V - V), finest.errorBound);
  EXPECT_LT(finest.errorBound, 1e-12);
}

TEST(DynamicProgramming, SaysWhenNothingEnds) {
  // Staying in state 0 costs nothing or pays; state 1 is the end.
  Mdp mdp;
  mdp.discount = 1;
  mdp.terminal = {false, true};
  mdp.rewards = Eigen::Matrix2d::Zero();
  mdp.rewards(1, 0) = mdp.rewards(1, 1) = 3;
  mdp.transitions.assign(2, TransitionMatrix(2, 2));
  mdp.transitions[0].insert(0, 0) = 1;
  mdp.transitions[1].insert(0, 1) = 1;
  const MdpSolution fine = policyIteration(mdp);
  EXPECT_EQ(fine.status, MdpStatus::kSolved);
  EXPECT_EQ(fine.V, Eigen::Vector2d(3, 3));
  mdp.rewards(0, 0) = 1;
  const MdpSolution endless = policyIteration(mdp);
  EXPECT_EQ(endless.status, MdpStatus::kEndless);
  EXPECT_EQ(endless.errorBound, std::numeric_limits<double>::infinity());
  EXPECT_EQ(endless.message,
            "policy 2: without discount there is no value: from state 0 no terminal state is reached");
  mdp.transitions[1] = mdp.transitions[0];
  EXPECT_EQ(policyIteration(mdp).status, MdpStatus::kEndless);
  EXPECT_EQ(policyValues(mdp, uniformPolicy(mdp)).status, MdpStatus::kEndless);
  EXPECT_REX_ERROR(discountedVisits(mdp, uniformPolicy(mdp), Eigen::Vector2d(1, 0)),
                   "from state 0 no terminal state is reached");
  EXPECT_EQ(policyIteration(tMaze(), 1).status, MdpStatus::kNotConverged);
}

TEST(DynamicProgramming, RefusesWrongOptions) {
  Mdp mdp = tMaze();
  EXPECT_REX_ERROR(valueIteration(mdp, {.tolerance = 0}),
                   "tolerance of value iteration: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(valueIteration(mdp, {.tolerance = INFINITY}), "tolerance of value iteration: found inf");
  EXPECT_REX_ERROR(valueIteration(mdp, {.maxIterations = 0}),
                   "maxIterations of value iteration: found 0, wanted at least 1");
  EXPECT_REX_ERROR(policyIteration(mdp, 0), "maxIterations of policy iteration: found 0, wanted at least 1");
  mdp.discount = 1;
  EXPECT_REX_ERROR(valueIteration(mdp), "discount of value iteration: found 1, wanted less than 1");
  mdp.discount = 2;
  EXPECT_REX_ERROR(policyIteration(mdp), "discount: found 2");
}

}  // namespace rex::dynamic_programming_test
