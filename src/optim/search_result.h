#pragma once

#include <limits>
#include <string>

#include <Eigen/Core>

namespace rex {

/// Why a search without derivatives ended.
enum class SearchStatus {
  kTargetReached,   ///< a value at or below the target
  kBudgetSpent,     ///< as many evaluations as were allowed
  kSmallSteps,      ///< steps fell below the tolerance
  kFlat,            ///< values no longer differ by more than the tolerance
  kNoEffect,        ///< steps vanish in the rounding of x
  kStagnated,       ///< values have not become better for long
  kIllConditioned,  ///< the covariance has become too thin to compute with
  kDiverged         ///< steps grew far beyond the first ones
};

/// As words: "target reached", "budget spent", "small steps" ...
[[nodiscard]] const char* nameOf(SearchStatus status);

/// The best point a search has seen. It is a good one only if `status` says so: a target, small steps.
struct SearchResult {
  SearchStatus status = SearchStatus::kBudgetSpent;
  Eigen::VectorXd x{};                                     ///< of finite value; the start if there was none
  double value = std::numeric_limits<double>::infinity();  ///< at x
  long evaluations = 0;
  long iterations = 0;
  long invalid = 0;  ///< evaluations without a finite value
  std::string message = "no search has run";

  /// Notes a point that was evaluated.
  void add(const Eigen::Ref<const Eigen::VectorXd>& point, double valueThere);
  /// Ends with a sentence about how it went.
  void end(SearchStatus why);
};

}  // namespace rex
