#pragma once

#include <limits>
#include <vector>

#include "base/rng.h"
#include "optim/cma_es.h"
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

/// Minimises f by CMA-ES (cma_es.h) from N(start, diag(deviations)^2): f gets the n x lambda samples of a
/// generation at once. Throws like CmaEs and CmaTermination.
[[nodiscard]] SearchResult minimizeByCma(const BatchObjective& f, const VectorArg& start,
                                         const VectorArg& deviations, Rng& rng,
                                         const CmaOptions& options = {}, const CmaLimits& limits = {});

struct RestartOptions {
  CmaOptions first{};  ///< of the first run
  CmaLimits limits{};  ///< the target and the budget are for all runs together
  double growth = 2;   ///< factor of lambda from one run to the next, until a generation has 10^7 numbers
  int maxRestarts = 9;
};

struct RestartResult : SearchResult {
  std::vector<SearchResult> runs{};  ///< the individual runs
};

/// Minimises f by runs of CMA-ES with increasing populations, which capture more and more of f's global
/// structure (IPOP-CMA-ES: Auger and Hansen, CEC 2005). Each starts at a random point in [low, high].
/// Throws like minimizeByCma, and for a box with low above high, growth outside [1, 100], and a negative
/// count.
[[nodiscard]] RestartResult minimizeByRestarts(const BatchObjective& f, const VectorArg& low,
                                               const VectorArg& high, const VectorArg& deviations, Rng& rng,
                                               const RestartOptions& options = {});

}  // namespace rex
