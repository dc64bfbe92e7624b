#pragma once

#include <string>
#include <vector>

#include "learning/linear_gaussian_policy.h"

namespace rex {

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

}  // namespace rex
