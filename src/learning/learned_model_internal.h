#pragma once

#include <Eigen/Core>

#include "base/rng.h"

namespace rex::internal {

/// A draw from the Gamma distribution of this shape, at least 1, and scale 1, by rejection (Marsaglia and
/// Tsang, 2000).
[[nodiscard]] double drawnGamma(double shape, Rng& rng);

/// Probabilities drawn from the Dirichlet distribution with these positive weights, which may be tiny.
[[nodiscard]] Eigen::VectorXd drawnDirichlet(const Eigen::VectorXd& weights, Rng& rng);

}  // namespace rex::internal
