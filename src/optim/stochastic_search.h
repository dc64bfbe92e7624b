#pragma once

#include <limits>

#include "base/rng.h"
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
