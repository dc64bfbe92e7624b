#include "learning/q_learning.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/mdp_rollout.h"
#include "learning/policy_values.h"

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
}

int epsilonGreedyAction(const Eigen::MatrixXd& Q, int s, double epsilon, Rng& rng) {
  if (rng.uniform() < epsilon) return rng.index(static_cast<int>(Q.cols()));
  int best = 0;
  Q.row(s).maxCoeff(&best);
  return best;
}

double runEpisode(const Mdp& mdp, const TabularOptions& options, Target target, int s, TabularResult& result,
                  Rng& rng) {
  double sum = 0, weight = 1;
  int a = epsilonGreedyAction(result.Q, s, options.epsilon, rng);
  for (int t = 0; t < options.maxSteps; ++t) {
    const bool ends = mdp.isTerminal(s);
    const double reward = mdp.rewards(s, a);
    const int next = ends ? s : sampledNext(mdp, s, a, rng);
    const int nextAction = ends ? a : epsilonGreedyAction(result.Q, next, options.epsilon, rng);
    const double later = target == Target::kBest ? result.Q.row(next).maxCoeff() : result.Q(next, nextAction);
    const double step = std::pow(++result.visits(s, a), -options.stepExponent);
    result.Q(s, a) += step * (reward + (ends ? 0 : mdp.discount * later) - result.Q(s, a));
    sum += weight * reward;
    weight *= mdp.discount;
    if (ends) break;
    s = next;
    a = nextAction;
  }
  return sum;
}

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
  TabularResult result;
  result.Q.setZero(mdp.states(), mdp.actions());
  result.visits.setZero(mdp.states(), mdp.actions());
  for (int i = 0; i < options.episodes; ++i)
    result.returns.push_back(runEpisode(mdp, options, target, sampledAction(start, 0, rng), result, rng));
  result.untried = static_cast<int>((result.visits.array() == 0).count());
  return result;
}

}  // namespace

TabularResult qLearning(const Mdp& mdp, const TabularOptions& options, Rng& rng) {
  return learned(mdp, options, Target::kBest, rng);
}

TabularResult sarsa(const Mdp& mdp, const TabularOptions& options, Rng& rng) {
  return learned(mdp, options, Target::kTaken, rng);
}

}  // namespace rex
