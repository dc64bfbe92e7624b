#pragma once

#include "control/racer_rollouts.h"
#include "control/racer_rollouts_kernel_internal.h"

namespace rex::internal {

/// The function of racer_rollouts.h by a kernel of the caller's choice.
[[nodiscard]] Rollouts racerRollouts(const RacerRolloutsKernel& kernel, const MatrixArg& W,
                                     const std::vector<Trial>& trials, const RacerRolloutOptions& options);

}  // namespace rex::internal
