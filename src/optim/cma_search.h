#pragma once

#include <vector>

#include "optim/cma_termination.h"
#include "optim/objective.h"

namespace rex {

/// Minimises f by CMA-ES (cma_es.h) from N(start, diag(deviations)^2): f sees the n x lambda samples of a
/// generation at once. Throws as CmaEs and CmaTermination.
[[nodiscard]] SearchResult minimizeByCma(const BatchObjective& f, const VectorArg& start,
                                         const VectorArg& deviations, Rng& rng,
                                         const CmaOptions& options = {}, const CmaLimits& limits = {});

struct RestartOptions {
  CmaOptions first{};  ///< of the first run
  CmaLimits limits{};  ///< the target and the budget are those of all runs together
  double growth = 2;   ///< of lambda from one run to the next, until a generation has 10^7 numbers
  int maxRestarts = 9;
};

struct RestartResult : SearchResult {
  std::vector<SearchResult> runs{};  ///< each by itself
};

/// Minimises f by runs of CMA-ES with ever larger populations, which see more and more of how f looks from
/// afar (IPOP-CMA-ES: Auger and Hansen, CEC 2005). Each starts somewhere in [low, high]. Throws as
/// minimizeByCma, and Error for a box whose upper end is the lower one, growth outside [1, 100], and a
/// negative count.
[[nodiscard]] RestartResult minimizeByRestarts(const BatchObjective& f, const VectorArg& low,
                                               const VectorArg& high, const VectorArg& deviations, Rng& rng,
                                               const RestartOptions& options = {});

}  // namespace rex
