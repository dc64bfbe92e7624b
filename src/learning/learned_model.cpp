#include "learning/learned_model.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/dynamic_programming.h"
#include "learning/mdp_rollout.h"
#include "learning/policy_values.h"

namespace rex {
namespace {

void requireIndex(const char* what, int found, Eigen::Index count) {
  if (found >= 0 && found < count) return;
  throw Error(
      {.what = what, .found = fmt::format("{}", found), .wanted = fmt::format("one of 0 to {}", count - 1)});
}

}  // namespace

LearnedModel::LearnedModel(int states, int actions) {
  requireCount("states of a model", states, 1);
  requireCount("actions of a model", actions, 1);
  counts_.assign(static_cast<std::size_t>(actions), Eigen::MatrixXd::Zero(states, states));
  tried_.setZero(states, actions);
  paid_.setZero(states, actions);
  terminal_.assign(static_cast<std::size_t>(states), false);
}

void LearnedModel::observe(int s, int a, double reward, std::optional<int> next) {
  requireIndex("state of a model", s, tried_.rows());
  requireIndex("action of a model", a, tried_.cols());
  if (next) requireIndex("next state of a model", *next, tried_.rows());
  if (!std::isfinite(reward))
    throw Error({.what = "reward", .found = fmt::format("{:g}", reward), .wanted = "a finite number"});
  tried_(s, a) += 1;
  paid_(s, a) += reward;
  if (next)
    counts_[static_cast<std::size_t>(a)](s, *next) += 1;
  else
    terminal_[static_cast<std::size_t>(s)] = true;
}

int LearnedModel::visits(int s, int a) const {
  requireIndex("state of a model", s, tried_.rows());
  requireIndex("action of a model", a, tried_.cols());
  return static_cast<int>(tried_(s, a));
}

Mdp LearnedModel::modelWith(double discount, int known, double unknownReward) const {
  Mdp mdp{.rewards = paid_.cwiseQuotient(tried_.cwiseMax(1)), .discount = discount, .terminal = terminal_};
  for (Eigen::Index a = 0; a < tried_.cols(); ++a) {
    Eigen::MatrixXd P = counts_[static_cast<std::size_t>(a)];
    for (Eigen::Index s = 0; s < tried_.rows(); ++s) {
      const bool ends = terminal_[static_cast<std::size_t>(s)];
      if (tried_(s, a) < known) {
        P.row(s) = Eigen::RowVectorXd::Unit(P.cols(), s);
        mdp.rewards(s, a) = ends ? unknownReward / (1 - discount) : unknownReward;
      } else {
        P.row(s) /= tried_(s, a);
      }
      if (ends) P.row(s).setZero();
    }
    mdp.transitions.emplace_back(P.sparseView());
  }
  return mdp;
}

Mdp LearnedModel::mostLikely(double discount) const {
  Mdp mdp = modelWith(discount, 1, 0);
  mdp.rewards =
      paid_.cwiseQuotient(tried_.cwiseMax(1));  // 0 / (1 - discount) is not a number if the discount is 1
  requireMdp(mdp);
  return mdp;
}

Mdp LearnedModel::optimistic(double discount, int known, double maxReward) const {
  requireCount("visits that make a pair known", known, 1);
  Mdp mdp = modelWith(discount, known, maxReward);
  requireMdp(mdp);
  return mdp;
}

RMaxResult rMax(const Mdp& mdp, const RMaxOptions& options, Rng& rng) {
  requireMdp(mdp);
  requireCount("episodes", options.episodes, 1);
  requireCount("steps of an episode", options.maxSteps, 1);
  Eigen::MatrixXd start = Eigen::MatrixXd::Constant(1, mdp.states(), 1. / mdp.states());
  if (options.start.size() > 0) {
    requireStart(mdp, options.start);
    start = options.start.transpose();
  }
  RMaxResult result{.model = LearnedModel(mdp.states(), mdp.actions())};
  const auto plan = [&] {
    result.Q = valueIteration(result.model.optimistic(mdp.discount, options.known, options.maxReward),
                              {.tolerance = 1e-6})
                   .Q;
  };
  plan();
  for (int e = 0; e < options.episodes; ++e) {
    double weight = 1;
    result.returns.push_back(0);
    int s = sampledAction(start, 0, rng);
    for (int t = 0; t < options.maxSteps; ++t) {
      int a = 0;
      result.Q.row(s).maxCoeff(&a);
      const bool ends = mdp.isTerminal(s);
      const int next = ends ? s : sampledNext(mdp, s, a, rng);
      result.model.observe(s, a, mdp.rewards(s, a), ends ? std::nullopt : std::optional(next));
      result.returns.back() += weight * mdp.rewards(s, a);
      weight *= mdp.discount;
      if (result.model.visits(s, a) == options.known) plan();
      if (ends) break;
      s = next;
    }
  }
  for (int s = 0; s < mdp.states(); ++s)
    for (int a = 0; a < mdp.actions(); ++a)
      result.unknown += result.model.visits(s, a) < options.known ? 1 : 0;
  return result;
}

}  // namespace rex
