#include "learning/mdp.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr double kTolerance = 1e-9;

void requireRow(const Mdp& mdp, int action, int state) {
  const auto what = [&] { return fmt::format("transition of action {} from state {}", action, state); };
  double sum = 0;
  for (TransitionMatrix::InnerIterator entry(mdp.transitions[static_cast<std::size_t>(action)], state); entry;
       ++entry) {
    if (!(entry.value() >= 0) || !std::isfinite(entry.value()))
      throw Error({.what = fmt::format("{} to state {}", what(), entry.col()),
                   .found = fmt::format("{:g}", entry.value()),
                   .wanted = "a probability"});
    sum += entry.value();
  }
  if (mdp.isTerminal(state) ? sum == 0 : std::abs(sum - 1) <= kTolerance) return;
  throw Error({.what = what(),
               .found = fmt::format("probabilities that sum to {:.12g}", sum),
               .wanted = mdp.isTerminal(state) ? "none, because the state is terminal" : "a sum of 1"});
}

void requireSizes(const Mdp& mdp) {
  if (mdp.rewards.size() == 0)
    throw Error({.what = "rewards of the decision process",
                 .found = fmt::format("{} x {}", mdp.rewards.rows(), mdp.rewards.cols()),
                 .wanted = "states x actions, at least one of each"});
  requireSize("transition matrices, one for each action", static_cast<long>(mdp.transitions.size()),
              mdp.actions());
  if (!mdp.terminal.empty())
    requireSize("terminal, one for each state", static_cast<long>(mdp.terminal.size()), mdp.states());
  for (std::size_t a = 0; a < mdp.transitions.size(); ++a) {
    const TransitionMatrix& P = mdp.transitions[a];
    if (P.rows() == mdp.states() && P.cols() == mdp.states()) continue;
    throw Error({.what = fmt::format("transitions of action {}", a),
                 .found = fmt::format("{} x {}", P.rows(), P.cols()),
                 .wanted = fmt::format("{0} x {0}, one row and column for each state", mdp.states())});
  }
}

}  // namespace

void requireMdp(const Mdp& mdp) {
  requireSizes(mdp);
  if (!(mdp.discount >= 0 && mdp.discount <= 1))
    throw Error(
        {.what = "discount", .found = fmt::format("{:g}", mdp.discount), .wanted = "a number in [0, 1]"});
  for (int s = 0; s < mdp.states(); ++s)
    for (int a = 0; a < mdp.actions(); ++a) {
      if (!std::isfinite(mdp.rewards(s, a)))
        requireFinite(fmt::format("reward of action {} in state {}", a, s), mdp.rewards(s, a));
      requireRow(mdp, a, s);
    }
}

std::vector<Eigen::MatrixXd> denseTransitions(const Mdp& mdp) {
  return {mdp.transitions.begin(), mdp.transitions.end()};
}

Eigen::MatrixXd rewardsOnEntering(const std::vector<TransitionMatrix>& transitions,
                                  const VectorArg& entered) {
  Eigen::MatrixXd rewards(entered.size(), static_cast<Eigen::Index>(transitions.size()));
  for (std::size_t a = 0; a < transitions.size(); ++a) {
    requireSize(fmt::format("rows of the transitions of action {}", a), transitions[a].rows(),
                entered.size());
    requireSize(fmt::format("columns of the transitions of action {}", a), transitions[a].cols(),
                entered.size());
    rewards.col(static_cast<Eigen::Index>(a)) = transitions[a] * entered;
  }
  return rewards;
}

void requirePolicy(const Mdp& mdp, const MatrixArg& policy) {
  if (policy.rows() != mdp.states() || policy.cols() != mdp.actions())
    throw Error({.what = "policy",
                 .found = fmt::format("{} x {}", policy.rows(), policy.cols()),
                 .wanted = fmt::format("states x actions, {} x {}", mdp.states(), mdp.actions())});
  for (Eigen::Index s = 0; s < policy.rows(); ++s) {
    for (Eigen::Index a = 0; a < policy.cols(); ++a)
      if (!(policy(s, a) >= 0) || !std::isfinite(policy(s, a)))
        throw Error({.what = fmt::format("policy in state {}, action {}", s, a),
                     .found = fmt::format("{:g}", policy(s, a)),
                     .wanted = "a probability"});
    if (std::abs(policy.row(s).sum() - 1) > kTolerance)
      throw Error({.what = fmt::format("policy in state {}", s),
                   .found = fmt::format("probabilities that sum to {:.12g}", policy.row(s).sum()),
                   .wanted = "a sum of 1"});
  }
}

Eigen::MatrixXd uniformPolicy(const Mdp& mdp) {
  return Eigen::MatrixXd::Constant(mdp.states(), mdp.actions(), 1. / mdp.actions());
}

Eigen::MatrixXd deterministicPolicy(const Mdp& mdp, const std::vector<int>& actions) {
  requireSize("actions, one for each state", static_cast<long>(actions.size()), mdp.states());
  Eigen::MatrixXd policy = Eigen::MatrixXd::Zero(mdp.states(), mdp.actions());
  for (int s = 0; s < mdp.states(); ++s) {
    const int a = actions[static_cast<std::size_t>(s)];
    if (a < 0 || a >= mdp.actions())
      throw Error({.what = fmt::format("action in state {}", s),
                   .found = fmt::format("{}", a),
                   .wanted = fmt::format("one of 0 to {}", mdp.actions() - 1)});
    policy(s, a) = 1;
  }
  return policy;
}

Eigen::MatrixXd epsilonGreedy(const MatrixArg& Q, double epsilon) {
  if (!(epsilon >= 0 && epsilon <= 1))
    throw Error({.what = "epsilon", .found = fmt::format("{:g}", epsilon), .wanted = "a number in [0, 1]"});
  const std::vector<int> best = greedyActions(Q);
  Eigen::MatrixXd policy =
      Eigen::MatrixXd::Constant(Q.rows(), Q.cols(), epsilon / static_cast<double>(Q.cols()));
  for (Eigen::Index s = 0; s < Q.rows(); ++s) policy(s, best[static_cast<std::size_t>(s)]) += 1 - epsilon;
  return policy;
}

Eigen::MatrixXd actionValues(const Mdp& mdp, const VectorArg& V) {
  requireSize("values, one for each state", V.size(), mdp.states());
  Eigen::MatrixXd Q = mdp.rewards;
  for (int a = 0; a < mdp.actions(); ++a)
    Q.col(a).noalias() += mdp.discount * (mdp.transitions[static_cast<std::size_t>(a)] * V);
  return Q;
}

std::vector<int> greedyActions(const MatrixArg& Q) {
  if (Q.cols() == 0) throw Error({.what = "values of actions", .found = "no action"});
  std::vector<int> best(static_cast<std::size_t>(Q.rows()));
  for (Eigen::Index s = 0; s < Q.rows(); ++s) Q.row(s).maxCoeff(&best[static_cast<std::size_t>(s)]);
  return best;
}

namespace {

MdpEpisode episode(const Mdp& mdp, const MatrixArg& policy, int start, int maxSteps, Rng& rng) {
  MdpEpisode result;
  double weight = 1;
  for (int s = start; static_cast<int>(result.states.size()) < maxSteps && !result.ended;) {
    const int a = sampledAction(policy, s, rng);
    result.states.push_back(s);
    result.actions.push_back(a);
    result.discountedReturn += weight * mdp.rewards(s, a);
    result.ended = mdp.isTerminal(s);
    weight *= mdp.discount;
    if (!result.ended) s = sampledNext(mdp, s, a, rng);
  }
  return result;
}

void requireEpisode(const Mdp& mdp, const MatrixArg& policy, int start, int maxSteps) {
  requireMdp(mdp);
  requirePolicy(mdp, policy);
  if (start < 0 || start >= mdp.states())
    throw Error({.what = "start of an episode",
                 .found = fmt::format("state {}", start),
                 .wanted = fmt::format("one of 0 to {}", mdp.states() - 1)});
  requireCount("steps of an episode", maxSteps, 1);
}

}  // namespace

int sampledNext(const Mdp& mdp, int s, int a, Rng& rng) {
  double left = rng.uniform();
  int next = s;
  for (TransitionMatrix::InnerIterator entry(mdp.transitions[static_cast<std::size_t>(a)], s); entry;
       ++entry) {
    if (entry.value() <= 0) continue;
    next = static_cast<int>(entry.col());
    left -= entry.value();
    if (left < 0) break;
  }
  return next;
}

int sampledAction(const MatrixArg& policy, int s, Rng& rng) {
  double left = rng.uniform();
  int action = 0;
  for (Eigen::Index a = 0; a < policy.cols(); ++a) {
    if (policy(s, a) <= 0) continue;
    action = static_cast<int>(a);
    left -= policy(s, a);
    if (left < 0) break;
  }
  return action;
}

MdpEpisode mdpEpisode(const Mdp& mdp, const MatrixArg& policy, int start, int maxSteps, Rng& rng) {
  requireEpisode(mdp, policy, start, maxSteps);
  return episode(mdp, policy, start, maxSteps, rng);
}

ReturnEstimate estimatedReturn(const Mdp& mdp, const MatrixArg& policy, int start, int episodes, int maxSteps,
                               Rng& rng) {
  requireEpisode(mdp, policy, start, maxSteps);
  requireCount("episodes", episodes, 2);
  ReturnEstimate estimate;
  double squares = 0;  // of deviations from the running mean (Welford)
  for (int i = 0; i < episodes; ++i) {
    const MdpEpisode one = episode(mdp, policy, start, maxSteps, rng);
    const double deviation = one.discountedReturn - estimate.mean;
    estimate.mean += deviation / (i + 1);
    squares += deviation * (one.discountedReturn - estimate.mean);
    estimate.cut += one.ended ? 0 : 1;
  }
  estimate.standardError = std::sqrt(squares / (episodes - 1) / episodes);
  return estimate;
}

}  // namespace rex
