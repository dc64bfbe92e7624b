#pragma once

#include <limits>

#include "base/rng.h"
#include "optim/objective.h"
#include "optim/search_result.h"

namespace rex {

struct DistributionSearchOptions {
  int lambda = 0;               ///< samples per generation, at least 4; 0: 20 n, at least 100
  double share = 0.3;           ///< of them that the distribution is fitted to
  bool fullCovariance = true;   ///< otherwise coordinates are independent
  double smallestStep = 1e-12;  ///< of the largest deviation, relative to the first
  long maxEvaluations = 1'000'000;
  double target = -std::numeric_limits<double>::infinity();
};

/// Minimises f by estimation of distribution: the next generation is sampled from the normal distribution
/// that is most likely for the best samples of this one (EMNA and, with independent coordinates, UMDA:
/// Larranaga and Lozano 2001). Slide 9:27's scheme with nothing else; it shrinks too soon on slopes, which is
/// what CMA-ES mends. Throws Error for a start or deviation that is not finite, and options out of range.
[[nodiscard]] SearchResult minimizeByDistribution(const BatchObjective& f, const VectorArg& start,
                                                  double deviation, Rng& rng,
                                                  const DistributionSearchOptions& options = {});

}  // namespace rex
