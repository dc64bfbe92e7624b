#pragma once

#include "estimation/covariance.h"
#include "estimation/ekf_slam.h"

namespace rex::internal {

/// Throws Error for a transition without a mean, and noise that is not a covariance of three numbers.
void requireTransition(const PoseTransition& transition, Definiteness noise);

}  // namespace rex::internal
