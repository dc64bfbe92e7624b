#include "learning/learned_model.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/dynamic_programming.h"
#include "learning/learned_model_internal.h"
#include "learning/mdp.h"

namespace rex::internal {

double drawnGamma(double shape, Rng& rng) {
  const double d = shape - 1. / 3, c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = rng.normal(), v = std::pow(1 + c * x, 3);
    if (v > 0 && std::log(rng.uniform()) < x * x / 2 + d - d * v + d * std::log(v)) return d * v;
  }
}

// Independent Gamma draws, divided by their sum. Of a shape a it is one of a + 1 times U^(1 / a), which may
// underflow: hence logarithms.
Eigen::VectorXd drawnDirichlet(const Eigen::VectorXd& weights, Rng& rng) {
  Eigen::VectorXd logs(weights.size());
  for (Eigen::Index i = 0; i < weights.size(); ++i)
    logs[i] = std::log(drawnGamma(weights[i] + 1, rng)) + std::log(1 - rng.uniform()) / weights[i];
  const Eigen::VectorXd shares = (logs.array() - logs.maxCoeff()).exp();
  return shares / shares.sum();
}

}  // namespace rex::internal

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

Mdp LearnedModel::sampled(double discount, const ModelPrior& prior, Rng& rng) const {
  requirePositive("visits of a prior", prior.visits);
  requireFinite("mean reward of a prior", prior.rewardMean);
  requirePositive("deviation of the mean reward of a prior", prior.rewardDeviation);
  requirePositive("noise of rewards of a prior", prior.rewardNoise);
  const Eigen::Index n = tried_.rows();
  Mdp mdp{.rewards = Eigen::MatrixXd(n, tried_.cols()), .discount = discount, .terminal = terminal_};
  const double believed = std::pow(prior.rewardDeviation, -2), precision = std::pow(prior.rewardNoise, -2);
  for (Eigen::Index a = 0; a < tried_.cols(); ++a) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index s = 0; s < n; ++s) {
      const double certainty = believed + precision * tried_(s, a);
      const double mean = (believed * prior.rewardMean + precision * paid_(s, a)) / certainty;
      mdp.rewards(s, a) = mean + rng.normal() / std::sqrt(certainty);
      if (terminal_[static_cast<std::size_t>(s)]) continue;
      const Eigen::VectorXd weights =
          counts_[static_cast<std::size_t>(a)].row(s).array() + prior.visits / static_cast<double>(n);
      P.row(s) = internal::drawnDirichlet(weights, rng).transpose();
    }
    mdp.transitions.emplace_back(P.sparseView());
  }
  requireMdp(mdp);
  return mdp;
}

namespace {

// One episode by a table Q that `learn` may change after each step; the discounted return.
template <class Learn>
double episodeBy(const Eigen::MatrixXd& Q, const Mdp& mdp, const Eigen::VectorXd& start, int maxSteps,
                 LearnedModel& model, Rng& rng, const Learn& learn) {
  double sum = 0, weight = 1;
  int s = sampledAction(start.transpose(), 0, rng);
  for (int t = 0; t < maxSteps; ++t) {
    int a = 0;
    Q.row(s).maxCoeff(&a);
    const bool ends = mdp.isTerminal(s);
    const int next = ends ? s : sampledNext(mdp, s, a, rng);
    model.observe(s, a, mdp.rewards(s, a), ends ? std::nullopt : std::optional(next));
    sum += weight * mdp.rewards(s, a);
    weight *= mdp.discount;
    learn(s, a);
    if (ends) break;
    s = next;
  }
  return sum;
}

// Throws Error unless episodes can run; where they start.
Eigen::VectorXd startOfEpisodes(const Mdp& mdp, int episodes, int maxSteps, const Eigen::VectorXd& start) {
  requireMdp(mdp);
  requireCount("episodes", episodes, 1);
  requireCount("steps of an episode", maxSteps, 1);
  if (start.size() == 0) return Eigen::VectorXd::Constant(mdp.states(), 1. / mdp.states());
  requireStart(mdp, start);
  return start;
}

}  // namespace

PosteriorSamplingResult posteriorSampling(const Mdp& mdp, const PosteriorSamplingOptions& options, Rng& rng) {
  const Eigen::VectorXd start = startOfEpisodes(mdp, options.episodes, options.maxSteps, options.start);
  PosteriorSamplingResult result{.model = LearnedModel(mdp.states(), mdp.actions())};
  for (int e = 0; e < options.episodes; ++e) {
    result.Q = valueIteration(result.model.sampled(mdp.discount, options.prior, rng), {.tolerance = 1e-6}).Q;
    result.returns.push_back(
        episodeBy(result.Q, mdp, start, options.maxSteps, result.model, rng, [](int, int) {}));
  }
  return result;
}

RMaxResult rMax(const Mdp& mdp, const RMaxOptions& options, Rng& rng) {
  const Eigen::VectorXd start = startOfEpisodes(mdp, options.episodes, options.maxSteps, options.start);
  RMaxResult result{.model = LearnedModel(mdp.states(), mdp.actions())};
  const auto plan = [&] {
    result.Q = valueIteration(result.model.optimistic(mdp.discount, options.known, options.maxReward),
                              {.tolerance = 1e-6})
                   .Q;
  };
  plan();
  const auto learn = [&](int s, int a) {
    if (result.model.visits(s, a) == options.known) plan();
  };
  for (int e = 0; e < options.episodes; ++e)
    result.returns.push_back(episodeBy(result.Q, mdp, start, options.maxSteps, result.model, rng, learn));
  for (int s = 0; s < mdp.states(); ++s)
    for (int a = 0; a < mdp.actions(); ++a)
      result.unknown += result.model.visits(s, a) < options.known ? 1 : 0;
  return result;
}

}  // namespace rex
