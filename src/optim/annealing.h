#pragma once

#include <limits>

#include "base/rng.h"
#include "optim/objective.h"
#include "optim/search_result.h"

namespace rex {

struct AnnealingOptions {
  double deviation = 1;  ///< of the steps that are proposed
  /// Falls from the first to the last by the same factor at every step; both as differences of values.
  double firstTemperature = 10, lastTemperature = 1e-3;
  long maxEvaluations = 100'000;
  double target = -std::numeric_limits<double>::infinity();
};

struct AnnealingResult : SearchResult {
  Eigen::VectorXd last{};  ///< where it stood in the end
  long accepted = 0;       ///< steps
};

/// Minimises f by simulated annealing: slides 9:24, 9:28; Kirkpatrick, Gelatt and Vecchi, Science 1983. A
/// step N(0, deviation^2 I) to a value higher by d is taken with probability exp(-d / temperature), one to a
/// value that is not finite never, unless the start has none. Throws Error for a start that is not finite and
/// options out of range.
[[nodiscard]] AnnealingResult minimizeByAnnealing(const Objective& f, const VectorArg& start, Rng& rng,
                                                  const AnnealingOptions& options = {});

}  // namespace rex
