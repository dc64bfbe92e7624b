#pragma once

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

}  // namespace rex
