#pragma once

#include <limits>

#include "optim/search_result.h"

namespace rex {

struct SimplexOptions {
  double step = 1;              ///< length of the first edges
  double smallestStep = 1e-12;  ///< of all edges, relative to the first: then the search ends
  long maxEvaluations = 100'000;
  double target = -std::numeric_limits<double>::infinity();
};

/// Minimises f by the downhill simplex of Nelder and Mead (1965), which reflects its worst corner through
/// the middle of the others; with the factors of Gao and Han (2012), which depend on n. Needs no randomness.
/// In many dimensions it may end far from any minimum. Throws Error for a start that is not finite and
/// options out of range.
[[nodiscard]] SearchResult minimizeBySimplex(const Objective& f, const VectorArg& start,
                                             const SimplexOptions& options = {});

}  // namespace rex
