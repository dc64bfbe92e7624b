#include "learning/mdp_rollout.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
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
