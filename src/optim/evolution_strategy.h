#pragma once

#include <limits>

#include "base/rng.h"
#include "optim/objective.h"
#include "optim/search_result.h"

namespace rex {

struct EvolutionStrategyOptions {
  int mu = 0;      ///< parents; 0: a quarter of lambda
  int lambda = 0;  ///< offspring, more than mu; 0: four times mu, or without mu 4 + n
  /// Each child mutates its own deviation, and the best children pass theirs on. Otherwise it is fixed, as
  /// on slide 9:29.
  bool selfAdaptation = true;
  double target = -std::numeric_limits<double>::infinity();
  double smallestStep = 1e-12;  ///< relative to the first deviation
  long maxEvaluations = 100'000;
};

/// Minimises f by the (mu, lambda) evolution strategy of slide 9:29: samples N(mean, deviation^2 I), and
/// the mean moves to the mean of the mu best. Self-adaptation as in Beyer and Schwefel, Evolution
/// Strategies, 2002: a child's deviation is its parents' geometric mean times exp(N(0, 1/(2n))). Throws
/// Error for a start or deviation that is not finite, and options out of range. A generation without any
/// finite value changes nothing.
[[nodiscard]] SearchResult minimizeByEvolution(const BatchObjective& f, const VectorArg& start,
                                               double deviation, Rng& rng,
                                               const EvolutionStrategyOptions& options = {});

}  // namespace rex
