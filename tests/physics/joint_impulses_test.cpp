#include <cmath>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "physics/contact_free_motion_internal.h"

namespace rex::internal {
namespace {

struct Problem {
  Eigen::MatrixXd M;
  Eigen::VectorXd p;
  std::vector<JointGoals> goals;
};

bool coin(Rng& rng) { return rng.uniform(0, 1) < 0.5; }

// Friction, motors weak and strong, some with the friction's velocity, and limits, some of them a point.
JointGoals randomGoals(Rng& rng) {
  JointGoals goals;
  if (coin(rng)) goals[kFriction] = {0, -0.3, 0.3};
  if (coin(rng)) goals[kDamping] = {0, -kInfinity, kInfinity, rng.uniform(0.1, 10)};
  if (coin(rng)) {
    const double most = coin(rng) ? kInfinity : rng.uniform(0, 1);
    goals[kMotor] = {coin(rng) ? 0 : rng.uniform(-2, 2), -most, most};
  }
  if (coin(rng)) {
    const double lower = rng.uniform(-2, 0.5), upper = coin(rng) ? lower : rng.uniform(0.5, 2);
    if (coin(rng)) goals[kLowerLimit] = {lower, 0, kInfinity};
    if (coin(rng)) goals[kUpperLimit] = {upper, -kInfinity, 0};
  }
  return goals;
}

Problem randomProblem(Rng& rng, Eigen::Index count) {
  Eigen::MatrixXd G(count, count);
  for (Eigen::Index i = 0; i < count; ++i) G.col(i) = rng.normalVector(static_cast<int>(count));
  Eigen::MatrixXd M = G * G.transpose();
  M.diagonal().array() += 0.1;
  Problem problem{M, rng.normalVector(static_cast<int>(count)), {}};
  for (Eigen::Index i = 0; i < count; ++i) problem.goals.push_back(randomGoals(rng));
  return problem;
}

// The smallest and the largest impulse that the goals allow at this velocity; none if limits forbid it. A
// motor of any strength that wants to go beyond a limit rests at it.
std::pair<double, double> allowed(const JointGoals& goals, double v) {
  constexpr double kSame = 1e-9;
  const double least = goals[kLowerLimit] ? goals[kLowerLimit]->velocity : -kInfinity;
  const double most = goals[kUpperLimit] ? goals[kUpperLimit]->velocity : kInfinity;
  if (v < least - kSame || v > most + kSame) return {kInfinity, -kInfinity};
  double lowest = std::abs(v - most) < kSame ? -kInfinity : 0,
         highest = std::abs(v - least) < kSame ? kInfinity : 0;
  for (const int purpose : {kFriction, kMotor}) {
    if (!goals[purpose]) continue;
    const double away =
        v - std::min(std::max(goals[purpose]->velocity, purpose == kMotor ? least : -kInfinity),
                     purpose == kMotor ? most : kInfinity);
    lowest += away < -kSame ? goals[purpose]->highest : goals[purpose]->lowest;
    highest += away > kSame ? goals[purpose]->lowest : goals[purpose]->highest;
  }
  if (goals[kDamping]) {
    lowest -= v / goals[kDamping]->softness;
    highest -= v / goals[kDamping]->softness;
  }
  return {lowest, highest};
}

// The cost is strictly convex, so impulses that every goal allows prove the minimum.
void expectSolved(const Problem& problem, const Eigen::VectorXd& v) {
  const Eigen::VectorXd impulse = problem.M * v - problem.p;
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const auto [lowest, highest] = allowed(problem.goals[static_cast<std::size_t>(i)], v[i]);
    EXPECT_GE(impulse[i], lowest - 1e-8) << i << " at " << v[i];
    EXPECT_LE(impulse[i], highest + 1e-8) << i << " at " << v[i];
  }
}

TEST(JointImpulses, MeetTheConditionsOfTheMinimum) {
  for (const Eigen::Index count : {1, 2, 7, 30}) {
    JointImpulses warm(count);
    Eigen::VectorXd last = Eigen::VectorXd::Zero(count);
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
      SCOPED_TRACE(testing::Message() << count << " coordinates, seed " << seed);
      Rng rng(seed);
      const Problem problem = randomProblem(rng, count);
      JointImpulses cold(count);
      Eigen::VectorXd v = Eigen::VectorXd::Zero(count);
      for (Eigen::Index i = 0; i < count; ++i) {
        cold.set(i, problem.goals[static_cast<std::size_t>(i)]);
        warm.set(i, problem.goals[static_cast<std::size_t>(i)]);
      }
      Eigen::MatrixXd M = problem.M;
      ASSERT_TRUE(cold.solve(M, problem.p, v));
      expectSolved(problem, v);
      // From the end of another problem it finds the same.
      M = problem.M;
      ASSERT_TRUE(warm.solve(M, problem.p, last));
      EXPECT_LT((last - v).lpNorm<Eigen::Infinity>(), 1e-8);
    }
  }
}

TEST(JointImpulses, FindNothingWithoutMass) {
  JointImpulses impulses(1);
  impulses.set(0, {});
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(1, 1);
  Eigen::VectorXd v = Eigen::VectorXd::Zero(1);
  EXPECT_FALSE(impulses.solve(M, Eigen::VectorXd::Ones(1), v));
}

}  // namespace
}  // namespace rex::internal
