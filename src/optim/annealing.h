#pragma once

#include <limits>

#include "base/rng.h"
#include "optim/objective.h"
#include "optim/search_result.h"

namespace rex {

struct AnnealingOptions {
  double deviation = 1;  ///< standard deviation of the proposed steps
  /// The temperature falls from the first to the last by the same factor at every step; both are in units
  /// of f.
  double firstTemperature = 10, lastTemperature = 1e-3;
  long maxEvaluations = 100'000;
  double target = -std::numeric_limits<double>::infinity();
};

struct AnnealingResult : SearchResult {
  Eigen::VectorXd last{};  ///< the final point
  long accepted = 0;       ///< number of accepted steps
};

/// Minimises f by simulated annealing: slides 9:24, 9:28; Kirkpatrick, Gelatt and Vecchi, Science 1983. A
/// step N(0, deviation^2 I) to a value higher by d is accepted with probability exp(-d / temperature). A
/// step to a value that is not finite is never accepted, unless that of the start is not finite either.
/// Throws Error for a start that is not finite and options out of range.
[[nodiscard]] AnnealingResult minimizeByAnnealing(const Objective& f, const VectorArg& start, Rng& rng,
                                                  const AnnealingOptions& options = {});

}  // namespace rex
