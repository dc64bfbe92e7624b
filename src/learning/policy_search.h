#pragma once

#include <string>
#include <vector>

#include "learning/linear_gaussian_policy.h"

namespace rex {

enum class Baseline {
  kNone,
  kOptimal  ///< for each step and parameter the constant that minimises the variance of its terms
};

struct PolicyGradient {
  Eigen::VectorXd gradient{};       ///< k
  Eigen::VectorXd standardError{};  ///< of each entry; zero for a single episode
};

/// d/dbeta log pi(a | s) = phi phi^T epsilon / (phi^T Sigma phi), and zero if the action has no noise. k x
/// T, one column for each step. Throws like requirePolicy and requireEpisodes.
[[nodiscard]] Eigen::MatrixXd logGradients(const LinearGaussianPolicy& policy, const Episode& episode);

/// REINFORCE, slide 9:17: the mean of sum_t discount^t dlog pi(a_t | s_t) (Q_t - b_t). The baseline of an
/// episode is computed from the other ones, so the gradient stays unbiased (Peters and Schaal 2008). Throws
/// like logGradients, and for a discount outside [0, 1].
[[nodiscard]] PolicyGradient reinforceGradient(const LinearGaussianPolicy& policy,
                                               const std::vector<Episode>& episodes, double discount,
                                               Baseline baseline = Baseline::kOptimal);

/// w = F^-1 g. Directions that the noise does not explore stay zero; `rank` counts the others.
struct NaturalGradient {
  Eigen::VectorXd w{};         ///< k
  Eigen::VectorXd gradient{};  ///< k: g
  Eigen::MatrixXd fisher{};    ///< k x k: F, the mean of sum_t discount^t dlog pi dlog pi^T
  int rank = 0;
};

/// Slide 9:17: the REINFORCE gradient with the optimal baseline, times the inverse Fisher matrix. Throws
/// like reinforceGradient.
[[nodiscard]] NaturalGradient naturalGradient(const LinearGaussianPolicy& policy,
                                              const std::vector<Episode>& episodes, double discount);

/// The episodic natural actor critic (Peters and Schaal 2008): w and a constant fit the returns of whole
/// episodes with sum_t discount^t dlog pi^T w, by least squares. Here `gradient` is fisher * w. Throws like
/// reinforceGradient.
[[nodiscard]] NaturalGradient episodicNaturalGradient(const LinearGaussianPolicy& policy,
                                                      const std::vector<Episode>& episodes, double discount);

enum class PowerStatus {
  kMoved,
  kNoReturn  ///< all returns are zero, or some feature was never seen: the step is not determined
};

struct PowerStep {
  PowerStatus status = PowerStatus::kNoReturn;
  Eigen::VectorXd beta{};  ///< the new parameters; the old ones unless status is kMoved
  std::string message{};
};

/// One step of PoWER (Kober and Peters 2008): beta + [E sum_t W Q]^-1 E sum_t W epsilon Q with W = phi
/// phi^T / (phi^T Sigma phi) and Q the return to go. Slide 9:17 omits W, which is right only for a single
/// feature. Throws Error like requirePolicy and requireEpisodes, for a Sigma without noise in some
/// direction, a discount outside [0, 1], and a negative return: add a constant to the rewards.
[[nodiscard]] PowerStep powerStep(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                                  double discount);

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
/// like the chosen method (learning/policy_search.h, learning/policy_search.h).
[[nodiscard]] PolicySearchResult improvedPolicy(const RolloutSource& rollouts,
                                                const LinearGaussianPolicy& start,
                                                const PolicySearchOptions& options, Rng& rng);

}  // namespace rex
