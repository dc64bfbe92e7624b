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
      .1;  ///< limit on the norm of the change of beta; a gradient from few episodes may be huge
  double noiseDecay = 1;  ///< Sigma is multiplied by this after each iteration; in (0, 1]
};

enum class PolicySearchStatus {
  kFinished,  ///< all iterations are done; the optimum may not be reached
  kStuck,     ///< a gradient of zero, or PoWER without returns
  kDiverged   ///< returns or parameters are no longer finite
};

struct PolicySearchResult {
  PolicySearchStatus status = PolicySearchStatus::kFinished;
  LinearGaussianPolicy policy{};  ///< the last
  LinearGaussianPolicy best{};    ///< the one whose episodes had the highest mean return
  std::vector<double> returns{};  ///< mean return of each iteration, before its step
  int iterations = 0;
  std::string message{};
};

/// Improves a policy with its own episodes. Throws Error for options out of range, like requirePolicy, and
/// like the chosen method (learning/policy_gradient.h, learning/power.h).
[[nodiscard]] PolicySearchResult improvedPolicy(const RolloutSource& rollouts,
                                                const LinearGaussianPolicy& start,
                                                const PolicySearchOptions& options, Rng& rng);

}  // namespace rex
