#include "learning/policy_search.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/policy_gradient.h"
#include "learning/power.h"

namespace rex {
namespace {

void requireOptions(const PolicySearchOptions& options) {
  requireCount("iterations of the search", options.iterations, 1);
  requireCount("episodes of an iteration", options.episodes, 2);
  requirePositive("rate", options.rate);
  requirePositiveOrInfinite("longestStep", options.longestStep);
  if (!(options.noiseDecay > 0 && options.noiseDecay <= 1))
    throw Error({.what = "noiseDecay",
                 .found = fmt::format("{:g}", options.noiseDecay),
                 .wanted = "a number above 0, up to 1"});
}

Eigen::VectorXd stepOf(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                       const PolicySearchOptions& options) {
  switch (options.method) {
    case SearchMethod::kReinforce:
      return options.rate * reinforceGradient(policy, episodes, options.discount).gradient;
    case SearchMethod::kNaturalGradient:
      return options.rate * naturalGradient(policy, episodes, options.discount).w;
    case SearchMethod::kEpisodicNaturalGradient:
      return options.rate * episodicNaturalGradient(policy, episodes, options.discount).w;
    case SearchMethod::kPower:
      break;
  }
  return powerStep(policy, episodes, options.discount).beta - policy.beta;
}

bool areFinite(const std::vector<Episode>& episodes) {
  return std::all_of(episodes.begin(), episodes.end(), [](const Episode& episode) {
    return episode.rewards.allFinite() && episode.features.allFinite();
  });
}

}  // namespace

PolicySearchResult improvedPolicy(const RolloutSource& rollouts, const LinearGaussianPolicy& start,
                                  const PolicySearchOptions& options, Rng& rng) {
  requirePolicy(start);
  requireOptions(options);
  PolicySearchResult result;
  result.policy = result.best = start;
  double most = -std::numeric_limits<double>::infinity();
  const auto stopped = [&](PolicySearchStatus status, const char* why) {
    result.status = status;
    result.message = fmt::format("{} after {} iterations", why, result.iterations);
    return result;
  };
  while (result.iterations < options.iterations) {
    const std::vector<Episode> episodes = rollouts(result.policy, options.episodes, rng);
    if (!areFinite(episodes)) return stopped(PolicySearchStatus::kDiverged, "returns are no longer finite");
    result.returns.push_back(meanReturn(episodes, options.discount));
    if (result.returns.back() > most) {
      most = result.returns.back();
      result.best = result.policy;
    }
    Eigen::VectorXd step = stepOf(result.policy, episodes, options);
    if (!step.allFinite()) return stopped(PolicySearchStatus::kDiverged, "the step is not finite");
    if (step.isZero(0)) return stopped(PolicySearchStatus::kStuck, "no direction promises a higher return");
    if (step.norm() > options.longestStep) step *= options.longestStep / step.norm();
    result.policy.beta += step;
    result.policy.Sigma *= options.noiseDecay;
    ++result.iterations;
  }
  return stopped(PolicySearchStatus::kFinished, "finished");
}

}  // namespace rex
