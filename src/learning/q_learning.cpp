#include "learning/q_learning.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/dynamic_programming.h"
#include "learning/mdp.h"

namespace rex {
namespace {

enum class Target { kBest, kTaken };

void requireOptions(const TabularOptions& options) {
  const auto require = [](bool holds, const char* what, double found, const char* wanted) {
    if (!holds) throw Error({.what = what, .found = fmt::format("{:g}", found), .wanted = wanted});
  };
  requireCount("episodes", options.episodes, 1);
  requireCount("steps of an episode", options.maxSteps, 1);
  require(options.epsilon >= 0 && options.epsilon <= 1, "epsilon", options.epsilon, "a number in [0, 1]");
  require(options.stepExponent > .5 && options.stepExponent <= 1, "stepExponent", options.stepExponent,
          "a number above .5, up to 1: otherwise the values do not converge");
  require(options.stepSize >= 0 && options.stepSize <= 1, "stepSize", options.stepSize, "a number in [0, 1]");
  requireCount("planning steps", options.planningSteps, 0);
}

int epsilonGreedyAction(const Eigen::MatrixXd& Q, int s, double epsilon, Rng& rng) {
  if (rng.uniform() < epsilon) return rng.index(static_cast<int>(Q.cols()));
  const double best = Q.row(s).maxCoeff();
  const auto ties = static_cast<int>((Q.row(s).array() == best).count());
  int left = ties > 1 ? rng.index(ties) : 0;
  for (int a = 0;; ++a)
    if (Q(s, a) == best && left-- == 0) return a;
}

class Learner {
 public:
  Learner(const Mdp& mdp, const TabularOptions& options, Target target)
      : mdp_(mdp),
        options_(options),
        target_(target),
        memory_(options.planningSteps > 0 ? static_cast<std::size_t>(mdp.rewards.size()) : 0) {
    result_.Q.setZero(mdp.states(), mdp.actions());
    result_.visits.setZero(mdp.states(), mdp.actions());
  }

  void runEpisode(int s, Rng& rng) {
    double sum = 0, weight = 1;
    int a = epsilonGreedyAction(result_.Q, s, options_.epsilon, rng);
    int t = 0;
    for (; t < options_.maxSteps; ++t) {
      const bool ends = mdp_.isTerminal(s);
      const TabularStep step{s, a, mdp_.rewards(s, a),
                             ends ? std::nullopt : std::optional(sampledNext(mdp_, s, a, rng))};
      const int nextAction = ends ? a : epsilonGreedyAction(result_.Q, *step.next, options_.epsilon, rng);
      ++result_.visits(s, a);
      learn(step, target_ == Target::kTaken ? std::optional(nextAction) : std::nullopt);
      if (options_.planningSteps > 0) plan(step, rng);
      sum += weight * step.reward;
      weight *= mdp_.discount;
      if (ends) break;
      s = *step.next;
      // Q-learning may have changed its mind about s; SARSA must do what it learned from.
      a = target_ == Target::kTaken || options_.planningSteps == 0
              ? nextAction
              : epsilonGreedyAction(result_.Q, s, options_.epsilon, rng);
    }
    result_.returns.push_back(sum);
    result_.steps.push_back(t);
  }

  TabularResult takeResult() {
    result_.untried = static_cast<int>((result_.visits.array() == 0).count());
    return std::move(result_);
  }

 private:
  void learn(const TabularStep& step, std::optional<int> nextAction) {
    const double size = options_.stepSize > 0
                            ? options_.stepSize
                            : std::pow(result_.visits(step.s, step.a), -options_.stepExponent);
    learnFrom(result_.Q, step, nextAction, size, mdp_.discount);
  }

  void plan(const TabularStep& step, Rng& rng) {
    const auto pair = static_cast<std::size_t>(step.s * mdp_.actions() + step.a);
    if (memory_[pair].empty()) tried_.push_back(pair);
    memory_[pair].push_back(step);
    for (int i = 0; i < options_.planningSteps; ++i) {
      const std::vector<TabularStep>& seen =
          memory_[tried_[static_cast<std::size_t>(rng.index(static_cast<int>(tried_.size())))]];
      learn(seen[static_cast<std::size_t>(rng.index(static_cast<int>(seen.size())))], std::nullopt);
    }
  }

  const Mdp& mdp_;
  const TabularOptions& options_;
  Target target_;
  TabularResult result_{};
  std::vector<std::vector<TabularStep>> memory_;  // of each pair
  std::vector<std::size_t> tried_{};              // pairs
};

TabularResult learned(const Mdp& mdp, const TabularOptions& options, Target target, Rng& rng) {
  requireMdp(mdp);
  requireOptions(options);
  Eigen::MatrixXd start(1, mdp.states());
  if (options.start.size() == 0) {
    start.setConstant(1. / mdp.states());
  } else {
    requireStart(mdp, options.start);
    start = options.start.transpose();
  }
  Learner learner(mdp, options, target);
  for (int i = 0; i < options.episodes; ++i) learner.runEpisode(sampledAction(start, 0, rng), rng);
  return learner.takeResult();
}

}  // namespace

void learnFrom(Eigen::MatrixXd& Q, const TabularStep& step, std::optional<int> nextAction, double size,
               double discount) {
  double wanted = step.reward;
  if (step.next)
    wanted += discount * (nextAction ? Q(*step.next, *nextAction) : Q.row(*step.next).maxCoeff());
  Q(step.s, step.a) += size * (wanted - Q(step.s, step.a));
}

TabularResult qLearning(const Mdp& mdp, const TabularOptions& options, Rng& rng) {
  return learned(mdp, options, Target::kBest, rng);
}

TabularResult sarsa(const Mdp& mdp, const TabularOptions& options, Rng& rng) {
  if (options.planningSteps > 0)
    throw Error({.what = "planning steps of SARSA",
                 .found = fmt::format("{}", options.planningSteps),
                 .wanted = "none: remembered steps do not tell what it would do next"});
  return learned(mdp, options, Target::kTaken, rng);
}

}  // namespace rex
