#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "optim/cma_es.h"

namespace rex {

/// When CMA-ES ends: at a target, or by the criteria of section B.3 of the tutorial.
struct CmaLimits {
  double target = -std::numeric_limits<double>::infinity();
  long maxEvaluations = 10'000'000;
  double smallestStep = 1e-12;        ///< relative to the first deviation
  double smallestDifference = 1e-12;  ///< difference of values over 10 + 30 n / lambda generations
  double largestCondition = 1e14;     ///< condition number of C
  double largestGrowth = 1e4;         ///< growth of the longest axis
};

/// Monitors one run.
class CmaTermination {
 public:
  /// `es` must not have begun. Throws Error for an infinite target, and limits that are not numbers or not
  /// positive.
  CmaTermination(const CmaEs& es, const CmaLimits& limits);

  /// Call it after each update with the same values. Returns why the run should end, or nothing.
  [[nodiscard]] std::optional<SearchStatus> check(const CmaEs& es, const VectorArg& values);

 private:
  void remember(const VectorArg& values);
  [[nodiscard]] bool hasNoEffect(const CmaEs& es);
  [[nodiscard]] bool isFlat(const VectorArg& values) const;
  [[nodiscard]] bool isStagnating(int generation);
  [[nodiscard]] double medianOf(const std::vector<double>& history, std::size_t from, std::size_t count);

  CmaLimits limits_;
  double firstSigma_, firstAxis_;
  std::size_t flatSpan_, stagnationSpan_;
  std::vector<double> bests_, medians_, sorted_;  // of the generations, so far; room for a median
  Eigen::VectorXd moved_;
};

}  // namespace rex
