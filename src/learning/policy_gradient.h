#pragma once

#include <vector>

#include "learning/linear_gaussian_policy.h"

namespace rex {

enum class Baseline {
  kNone,
  kOptimal  ///< for each step and parameter the constant that makes the variance of its terms least
};

struct PolicyGradient {
  Eigen::VectorXd gradient{};       ///< k
  Eigen::VectorXd standardError{};  ///< of each entry; zero from one episode
};

/// d/dbeta log pi(a | s) = phi phi^T epsilon / (phi^T Sigma phi), and zero where the action has no noise.
/// k x T, one column for each step. Throws as requirePolicy and requireEpisodes.
[[nodiscard]] Eigen::MatrixXd logGradients(const LinearGaussianPolicy& policy, const Episode& episode);

/// REINFORCE, slide 9:17: the mean of sum_t discount^t dlog pi(a_t | s_t) (Q_t - b_t). The baseline of an
/// episode is made of the other ones, so that the gradient stays unbiased (Peters and Schaal 2008). Throws as
/// logGradients, and Error for a discount outside [0, 1].
[[nodiscard]] PolicyGradient reinforceGradient(const LinearGaussianPolicy& policy,
                                               const std::vector<Episode>& episodes, double discount,
                                               Baseline baseline = Baseline::kOptimal);

/// w = F^-1 g. Directions in which the noise shows nothing stay zero: `rank` counts the others.
struct NaturalGradient {
  Eigen::VectorXd w{};         ///< k
  Eigen::VectorXd gradient{};  ///< k: g
  Eigen::MatrixXd fisher{};    ///< k x k: F, the mean of sum_t discount^t dlog pi dlog pi^T
  int rank = 0;
};

/// Slide 9:17: the gradient of REINFORCE with the optimal baseline, times the inverse Fisher metric. Throws
/// as reinforceGradient.
[[nodiscard]] NaturalGradient naturalGradient(const LinearGaussianPolicy& policy,
                                              const std::vector<Episode>& episodes, double discount);

/// The episodic natural actor critic (Peters and Schaal 2008): w and a constant explain the returns of whole
/// episodes by sum_t discount^t dlog pi^T w, in least squares. Here `gradient` is fisher * w. Throws as
/// reinforceGradient.
[[nodiscard]] NaturalGradient episodicNaturalGradient(const LinearGaussianPolicy& policy,
                                                      const std::vector<Episode>& episodes, double discount);

}  // namespace rex
