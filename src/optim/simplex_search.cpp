#include "optim/simplex_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/require.h"
#include "optim/search_result_internal.h"

namespace rex {
namespace {

// n + 1 corners, the best one first.
class Corners {
 public:
  Corners(const VectorArg& start, double step)
      : X_(start.replicate(1, start.size() + 1)), values_(start.size() + 1) {
    for (Eigen::Index i = 0; i < start.size(); ++i) X_(i, i + 1) += step;
  }

  Eigen::Index count() const { return X_.cols(); }
  auto corner(Eigen::Index i) { return X_.col(i); }
  double& value(Eigen::Index i) { return values_[i]; }
  auto worst() { return X_.col(count() - 1); }
  // Of all corners but the worst.
  Eigen::VectorXd middle() const { return X_.leftCols(X_.cols() - 1).rowwise().mean(); }
  double size() const { return (X_.rightCols(X_.cols() - 1).colwise() - X_.col(0)).cwiseAbs().maxCoeff(); }

  void sort() {
    std::vector<Eigen::Index> order(static_cast<std::size_t>(count()));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return values_[i]; });
    X_ = X_(Eigen::all, order).eval();
    values_ = values_(order).eval();
  }

 private:
  Eigen::MatrixXd X_;
  Eigen::VectorXd values_;
};

}  // namespace

SearchResult minimizeBySimplex(const Objective& f, const VectorArg& start, const SimplexOptions& options) {
  internal::requireSearch("simplex search", start, options.step, options.target, options.maxEvaluations);
  requirePositive("simplex search: smallest step", options.smallestStep);
  const auto n = static_cast<double>(start.size());
  const double expansion = 1 + 2 / n, contraction = n > 1 ? 0.75 - 1 / (2 * n) : 0.5,
               shrinking = n > 1 ? 1 - 1 / n : 0.5;
  SearchResult result;
  result.x = start;
  // The value there; infinity where it is not finite. Must not be called without budget.
  const auto evaluated = [&](const Eigen::VectorXd& x) {
    const double value = f(x);
    result.add(x, value);
    return std::isfinite(value) ? value : std::numeric_limits<double>::infinity();
  };
  const auto isSpent = [&] { return result.evaluations >= options.maxEvaluations; };
  Corners corners(start, options.step);
  for (Eigen::Index i = 0; i < corners.count(); ++i)
    corners.value(i) = isSpent() ? std::numeric_limits<double>::infinity() : evaluated(corners.corner(i));

  while (true) {
    corners.sort();
    if (result.value <= options.target) return result.end(SearchStatus::kTargetReached), result;
    // A step evaluates two points, or all but the best.
    if (result.evaluations + corners.count() > options.maxEvaluations)
      return result.end(SearchStatus::kBudgetSpent), result;
    if (!(corners.size() > options.smallestStep * options.step))
      return result.end(SearchStatus::kSmallSteps), result;
    ++result.iterations;
    const Eigen::Index last = corners.count() - 1;
    const Eigen::VectorXd middle = corners.middle(), away = middle - corners.worst();
    const auto replaceWorst = [&](const Eigen::VectorXd& x, double value) {
      corners.worst() = x;
      corners.value(last) = value;
    };
    const Eigen::VectorXd reflected = middle + away;
    const double value = evaluated(reflected);
    if (value < corners.value(0)) {
      const Eigen::VectorXd expanded = middle + expansion * away;
      const double further = evaluated(expanded);
      if (further < value)
        replaceWorst(expanded, further);
      else
        replaceWorst(reflected, value);
    } else if (value < corners.value(last - 1)) {
      replaceWorst(reflected, value);
    } else {
      const bool isOutside = value < corners.value(last);
      const Eigen::VectorXd contracted = middle + (isOutside ? contraction : -contraction) * away;
      const double nearer = evaluated(contracted);
      if (nearer < std::min(value, corners.value(last))) {
        replaceWorst(contracted, nearer);
      } else {
        for (Eigen::Index i = 1; i < corners.count(); ++i) {
          corners.corner(i) = corners.corner(0) + shrinking * (corners.corner(i) - corners.corner(0));
          corners.value(i) =
              isSpent() ? std::numeric_limits<double>::infinity() : evaluated(corners.corner(i));
        }
      }
    }
  }
}

}  // namespace rex
