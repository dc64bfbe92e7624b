#pragma once

#include <string>
#include <vector>

#include "learning/linear_gaussian_policy.h"

namespace rex {

enum class SearchMethod { kReinforce, kNaturalGradient, kEpisodicNaturalGradient, kPower };

struct PolicySearchOptions {
  SearchMethod method = SearchMethod::kNaturalGradient;
  int iterations = 100;
  int episodes = 50;  ///< in each iteration
  double discount = 1;
  double rate = .1;  ///< beta <- beta + rate * gradient; PoWER has none
  double longestStep =
      .1;                 ///< greatest length of the change of beta; a gradient from few episodes may be huge
  double noiseDecay = 1;  ///< Sigma is multiplied by this after each iteration; in (0, 1]
};

enum class PolicySearchStatus {
  kFinished,  ///< all iterations done; whether it is the optimum, nobody knows
  kStuck,     ///< a gradient of zero, or PoWER without returns
  kDiverged   ///< returns or parameters are no longer finite
};

struct PolicySearchResult {
  PolicySearchStatus status = PolicySearchStatus::kFinished;
  LinearGaussianPolicy policy{};  ///< the last
  LinearGaussianPolicy best{};    ///< the one whose own episodes returned most
  std::vector<double> returns{};  ///< mean return of each iteration, before its step
  int iterations = 0;
  std::string message{};
};

/// Improves a policy by its own episodes. Throws Error for options out of range, as requirePolicy, and as the
/// method does (learning/policy_gradient.h, learning/power.h).
[[nodiscard]] PolicySearchResult improvedPolicy(const Rollouts& rollouts, const LinearGaussianPolicy& start,
                                                const PolicySearchOptions& options, Rng& rng);

}  // namespace rex
