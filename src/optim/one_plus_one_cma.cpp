#include "optim/one_plus_one_cma.h"

#include <cmath>

#include "base/require.h"
#include "optim/search_checks_internal.h"

namespace rex {

SearchResult minimizeByOnePlusOne(const Objective& f, const VectorArg& start, double deviation, Rng& rng,
                                  const OnePlusOneOptions& options) {
  internal::requireSearch("(1+1)-CMA", start, deviation, options.target, options.maxEvaluations);
  requirePositive("(1+1)-CMA: smallest step", options.smallestStep);
  // The constants of the paper's table 1.
  const auto n = static_cast<double>(start.size());
  const double d = 1 + n / 2, wanted = 2. / 11, cp = 1. / 12, cc = 2 / (n + 2), cCov = 2 / (n * n + 6),
               fewSuccesses = 0.44;
  Eigen::VectorXd x = start, path = Eigen::VectorXd::Zero(start.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(start.size(), start.size()), inverse = A;
  double sigma = deviation, successes = wanted;
  SearchResult result;
  result.x = start;
  double value = f(x);
  result.add(x, value);
  while (true) {
    if (result.value <= options.target) return result.end(SearchStatus::kTargetReached), result;
    if (result.evaluations >= options.maxEvaluations) return result.end(SearchStatus::kBudgetSpent), result;
    if (!(sigma > options.smallestStep * deviation)) return result.end(SearchStatus::kSmallSteps), result;
    if (sigma > 1e100 * deviation) return result.end(SearchStatus::kDiverged), result;
    ++result.iterations;
    const Eigen::VectorXd step = A * rng.normalVector(static_cast<int>(start.size()));
    const Eigen::VectorXd child = x + sigma * step;
    const double childValue = f(child);
    result.add(child, childValue);
    const bool isSuccess = std::isfinite(childValue) && !(childValue > value);
    successes = (1 - cp) * successes + (isSuccess ? cp : 0);
    sigma *= std::exp((successes - wanted / (1 - wanted) * (1 - successes)) / d);
    if (!isSuccess) continue;
    x = child;
    value = childValue;
    // After many successes in a row sigma is too small, and the path would stretch A instead.
    const bool isLearning = successes < fewSuccesses;
    path = (1 - cc) * path + (isLearning ? std::sqrt(cc * (2 - cc)) : 0) * step;
    const double kept = isLearning ? 1 - cCov : 1 - cCov + cCov * cc * (2 - cc);
    // A A^T becomes kept A A^T + cCov path path^T; the inverse by Sherman and Morrison.
    const Eigen::VectorXd w = inverse * path;
    const double length = w.squaredNorm();
    if (!(length > 0)) continue;
    const double a = std::sqrt(kept), b = a / length * (std::sqrt(1 + cCov * length / kept) - 1);
    A = a * A + b * path * w.transpose();
    inverse = (inverse - b / (a + b * length) * w * (w.transpose() * inverse)) / a;
  }
}

}  // namespace rex
