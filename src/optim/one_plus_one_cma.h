#pragma once

#include <limits>

#include "base/rng.h"
#include "optim/objective.h"
#include "optim/search_result.h"

namespace rex {

struct OnePlusOneOptions {
  double smallestStep = 1e-12;  ///< relative to the first deviation
  long maxEvaluations = 100'000;
  double target = -std::numeric_limits<double>::infinity();
};

/// Minimises f by the (1+1)-CMA-ES: one child per generation, N(x, sigma^2 A A^T), replaces its parent if it
/// is not worse. The share of successes steers sigma, successful steps A (Igel, Suttorp and Hansen, GECCO
/// 2006). Fast downhill, blind to what lies beyond the next hill. Throws Error for a start or deviation that
/// is not finite, and options out of range.
[[nodiscard]] SearchResult minimizeByOnePlusOne(const Objective& f, const VectorArg& start, double deviation,
                                                Rng& rng, const OnePlusOneOptions& options = {});

}  // namespace rex
