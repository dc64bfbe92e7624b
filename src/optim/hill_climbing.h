#pragma once

#include <limits>

#include "base/rng.h"
#include "optim/objective.h"
#include "optim/search_result.h"

namespace rex {

struct HillClimbingOptions {
  double step = 1;             ///< initial step: a standard deviation, or the distance of neighbours
  double smallestStep = 1e-9;  ///< relative to the first
  int patience = 100;          ///< consecutive steps without success before the step size is halved
  long maxEvaluations = 100'000;
  double target = -std::numeric_limits<double>::infinity();
};

/// Minimises f by random steps N(0, step^2 I), accepted if they lower the value: the simplest search of
/// slide 9:24. It ends in a nearby local minimum (kSmallSteps). Throws Error for a start that is not finite
/// and options out of range.
[[nodiscard]] SearchResult climbByChance(const Objective& f, const VectorArg& start, Rng& rng,
                                         const HillClimbingOptions& options = {});

/// Moves to the best of the 2 n neighbours at x +- step e_i while one is lower than x, then halves the
/// step. Throws like climbByChance; `patience` has no effect.
[[nodiscard]] SearchResult climbToBestNeighbour(const BatchObjective& f, const VectorArg& start,
                                                const HillClimbingOptions& options = {});

}  // namespace rex
