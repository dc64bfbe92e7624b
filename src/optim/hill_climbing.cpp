#include "optim/hill_climbing.h"

#include <cmath>

#include "base/require.h"
#include "optim/search_checks_internal.h"

namespace rex {
namespace {

void requireSound(const VectorArg& start, const HillClimbingOptions& options) {
  internal::requireSearch("hill climbing", start, options.step, options.target, options.maxEvaluations);
  requirePositive("hill climbing: smallest step", options.smallestStep);
  requireCount("hill climbing: patience", options.patience, 1);
}

SearchStatus statusOf(const SearchResult& result, double step, const HillClimbingOptions& options) {
  if (result.value <= options.target) return SearchStatus::kTargetReached;
  return step < options.smallestStep * options.step ? SearchStatus::kSmallSteps : SearchStatus::kBudgetSpent;
}

}  // namespace

SearchResult climbByChance(const Objective& f, const VectorArg& start, Rng& rng,
                           const HillClimbingOptions& options) {
  requireSound(start, options);
  SearchResult result;
  result.x = start;
  result.add(start, f(start));
  Eigen::VectorXd x(start.size());
  double step = options.step;
  int failures = 0;
  while (result.value > options.target && result.evaluations < options.maxEvaluations &&
         step >= options.smallestStep * options.step) {
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = result.x[i] + step * rng.normal();
    const double before = result.value;
    result.add(x, f(x));
    ++result.iterations;
    failures = result.value < before ? 0 : failures + 1;
    if (failures < options.patience) continue;
    step /= 2;
    failures = 0;
  }
  result.end(statusOf(result, step, options));
  return result;
}

SearchResult climbToBestNeighbour(const BatchObjective& f, const VectorArg& start,
                                  const HillClimbingOptions& options) {
  requireSound(start, options);
  const Eigen::Index n = start.size();
  SearchResult result;
  result.x = start;
  Eigen::MatrixXd X(n, 2 * n);
  Eigen::VectorXd values(2 * n);
  X.col(0) = start;
  f(X.leftCols(1), values.head(1));
  result.add(start, values[0]);
  double step = options.step;
  while (result.value > options.target && result.evaluations + 2 * n <= options.maxEvaluations &&
         step >= options.smallestStep * options.step) {
    X.colwise() = result.x;
    X.leftCols(n).diagonal().array() += step;
    X.rightCols(n).diagonal().array() -= step;
    f(X, values);
    const double before = result.value;
    for (Eigen::Index i = 0; i < X.cols(); ++i) result.add(X.col(i), values[i]);
    ++result.iterations;
    if (!(result.value < before)) step /= 2;
  }
  result.end(statusOf(result, step, options));
  return result;
}

}  // namespace rex
