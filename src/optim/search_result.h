#pragma once

#include <functional>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// A function of n variables to be minimised.
using Objective = std::function<double(const VectorArg& x)>;

/// The same for many points at once: X is n x count, one point per column; values has `count` numbers. A
/// value that is not finite marks an invalid point: searches rank it last and count it.
using BatchObjective = std::function<void(const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> values)>;

/// Evaluates f for one point after the other.
[[nodiscard]] inline BatchObjective batched(Objective f) {
  return [f = std::move(f)](const MatrixArg& X, Eigen::Ref<Eigen::VectorXd> values) {
    for (Eigen::Index i = 0; i < X.cols(); ++i) values[i] = f(X.col(i));
  };
}

/// Why a search without derivatives ended.
enum class SearchStatus {
  kTargetReached,   ///< a value at or below the target
  kBudgetSpent,     ///< all permitted evaluations are used up
  kSmallSteps,      ///< steps fell below the tolerance
  kFlat,            ///< values no longer differ by more than the tolerance
  kNoEffect,        ///< steps vanish in the rounding of x
  kStagnated,       ///< values have not improved for long
  kIllConditioned,  ///< the covariance has become too ill-conditioned to compute with
  kDiverged         ///< steps grew far beyond the first ones
};

/// As words: "target reached", "budget spent", "small steps" ...
[[nodiscard]] const char* toString(SearchStatus status);

/// The best point a search has seen. It is reliable only if `status` says so: target reached, small steps.
struct SearchResult {
  SearchStatus status = SearchStatus::kBudgetSpent;
  Eigen::VectorXd x{};  ///< best point with a finite value; the start if there is none
  double value = std::numeric_limits<double>::infinity();  ///< at x
  long evaluations = 0;
  long iterations = 0;
  long invalid = 0;  ///< evaluations without a finite value
  std::string message = "no search has run";

  /// Records an evaluated point.
  void add(const Eigen::Ref<const Eigen::VectorXd>& point, double valueThere);
  /// Sets the status, and the message that describes it.
  void end(SearchStatus why);
};

}  // namespace rex
