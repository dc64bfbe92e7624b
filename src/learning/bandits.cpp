#include "learning/bandits.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "learning/learned_model_internal.h"

namespace rex {
namespace {

using Eigen::Index;

void requireShare(const std::string& what, double share) {
  if (share >= 0 && share <= 1) return;
  throw Error({.what = what, .found = fmt::format("{:g}", share), .wanted = "a number from 0 to 1"});
}

void requireRecord(const ArmRecord& record, double epsilon) {
  requireShare("bandit: epsilon", epsilon);
  requireCount("bandit: arms", static_cast<int>(record.pulls.size()), 1);
  requireSize("bandit: what each arm paid", record.paid.size(), record.pulls.size());
  for (Index k = 0; k < record.pulls.size(); ++k)
    if (!(record.paid[k] >= 0 && record.paid[k] <= record.pulls[k]))
      throw Error({.what = fmt::format("bandit: what arm {} paid", k),
                   .found = fmt::format("{:g} in {} pulls", record.paid[k], record.pulls[k]),
                   .wanted = "from 0 to 1 for each pull"});
}

double drawnBeta(double a, double b, Rng& rng) {
  const double x = internal::drawnGamma(a, rng);
  return x / (x + internal::drawnGamma(b, rng));
}

// One of the largest, each with the same probability.
int largest(const Eigen::VectorXd& numbers, Rng& rng) {
  const double most = numbers.maxCoeff();
  int left = rng.index(static_cast<int>((numbers.array() == most).count()));
  for (Index k = 0;; ++k)
    if (numbers[k] == most && left-- == 0) return static_cast<int>(k);
}

}  // namespace

int nextArm(const ArmRecord& record, BanditRule rule, Rng& rng, double epsilon) {
  requireRecord(record, epsilon);
  const Index count = record.pulls.size();
  Eigen::VectorXd worth(count);
  if (rule == BanditRule::kThompson) {
    for (Index k = 0; k < count; ++k)
      worth[k] = drawnBeta(1 + record.paid[k], 1 + record.pulls[k] - record.paid[k], rng);
    return largest(worth, rng);
  }
  if (record.pulls.minCoeff() == 0) return largest((record.pulls.array() == 0).cast<double>(), rng);
  if (rule == BanditRule::kEpsilonGreedy && rng.uniform() < epsilon)
    return rng.index(static_cast<int>(count));
  worth = record.paid.cwiseQuotient(record.pulls.cast<double>());
  if (rule == BanditRule::kUcb)
    worth.array() += (2 * std::log(record.pulls.sum()) / record.pulls.array().cast<double>()).sqrt();
  return largest(worth, rng);
}

BanditRun playBandit(const Eigen::VectorXd& probabilities, int pulls, BanditRule rule, Rng& rng,
                     double epsilon) {
  requireCount("bandit: pulls", pulls, 1);
  for (const double one : probabilities) requireShare("bandit: probability", one);
  const Index count = probabilities.size();
  BanditRun run{.record = {.pulls = Eigen::VectorXi::Zero(count), .paid = Eigen::VectorXd::Zero(count)}};
  double regret = 0;
  for (int n = 0; n < pulls; ++n) {
    const int arm = nextArm(run.record, rule, rng, epsilon);
    ++run.record.pulls[arm];
    run.record.paid[arm] += rng.uniform() < probabilities[arm] ? 1 : 0;
    regret += probabilities.maxCoeff() - probabilities[arm];
    run.regret.push_back(regret);
  }
  return run;
}

}  // namespace rex
