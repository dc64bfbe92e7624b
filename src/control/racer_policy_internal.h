#pragma once

#include "control/racer_policy.h"

namespace rex::internal {

/// Puts the weights of the features that a policy takes among those of all, with zeros for the others; one
/// all `stride` numbers.
void placeWeights(const RacerFeatures& features, const VectorArg& w, double* all, int stride);

}  // namespace rex::internal
