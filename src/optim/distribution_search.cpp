#include "optim/distribution_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>

#include "base/require.h"
#include "optim/search_checks_internal.h"

namespace rex {

SearchResult minimizeByDistribution(const BatchObjective& f, const VectorArg& start, double deviation,
                                    Rng& rng, const DistributionSearchOptions& options) {
  constexpr const char* kName = "distribution search";
  internal::requireSearch(kName, start, deviation, options.target, options.maxEvaluations);
  requirePositive("distribution search: smallest step", options.smallestStep);
  internal::requireSearchOption(options.share > 0 && options.share < 1, kName, "share", options.share,
                                "a number between 0 and 1");
  const Eigen::Index n = start.size();
  const int lambda = options.lambda != 0 ? options.lambda : std::max(100, 20 * static_cast<int>(n));
  internal::requireSearchOption(lambda >= 4 && lambda <= 1'000'000, kName, "lambda", lambda, "4 to 1000000");
  const auto mu = static_cast<Eigen::Index>(std::clamp(options.share * lambda, 2., lambda - 1.));

  Eigen::VectorXd mean = start, values(lambda), deviations = Eigen::VectorXd::Constant(n, deviation);
  Eigen::MatrixXd axes = Eigen::MatrixXd::Identity(n, n), X(n, lambda);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(lambda));
  SearchResult result;
  result.x = start;
  std::optional<SearchStatus> status;
  while (!status) {
    if (result.evaluations + lambda > options.maxEvaluations) {
      status = SearchStatus::kBudgetSpent;
      break;
    }
    for (Eigen::Index i = 0; i < lambda; ++i)
      X.col(i) = mean + axes * deviations.cwiseProduct(rng.normalVector(static_cast<int>(n)));
    f(X, values);
    for (Eigen::Index i = 0; i < lambda; ++i) {
      result.add(X.col(i), values[i]);
      if (!std::isfinite(values[i])) values[i] = std::numeric_limits<double>::infinity();
    }
    ++result.iterations;
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return values[i]; });
    if (std::isfinite(values[order[static_cast<std::size_t>(mu - 1)]])) {
      const Eigen::MatrixXd best = X(Eigen::all, std::vector(order.begin(), order.begin() + mu));
      mean = best.rowwise().mean();
      const Eigen::MatrixXd offsets = best.colwise() - mean;
      if (options.fullCovariance) {
        const Eigen::MatrixXd covariance = offsets * offsets.transpose() / static_cast<double>(mu);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(covariance);
        axes = parts.eigenvectors();
        deviations = parts.eigenvalues().cwiseMax(0).cwiseSqrt();
      } else {
        deviations = offsets.rowwise().norm() / std::sqrt(static_cast<double>(mu));
      }
    }
    if (result.value <= options.target)
      status = SearchStatus::kTargetReached;
    else if (!(deviations.maxCoeff() > options.smallestStep * deviation))
      status = SearchStatus::kSmallSteps;
  }
  result.end(*status);
  return result;
}

}  // namespace rex
