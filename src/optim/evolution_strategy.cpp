#include "optim/evolution_strategy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "base/require.h"
#include "optim/search_checks_internal.h"

namespace rex {
namespace {

constexpr const char* kEvolution = "evolution strategy";

struct Sizes {
  int mu, lambda;
};

Sizes sizesOf(Eigen::Index n, const EvolutionStrategyOptions& options) {
  const auto require = [](bool isRight, const char* what, int number, const char* wanted) {
    internal::requireSearchOption(isRight, kEvolution, what, number, wanted);
  };
  require(options.mu >= 0 && options.mu <= 100'000, "mu", options.mu, "1 to 100000, or 0 for the default");
  const int usual = options.mu > 0 ? 4 * options.mu : 4 + static_cast<int>(n);
  const int lambda = options.lambda != 0 ? options.lambda : usual;
  const int mu = options.mu > 0 ? options.mu : std::max(1, lambda / 4);
  require(lambda > mu && lambda <= 1'000'000, "lambda", lambda, "more than mu, at most 1000000");
  return {mu, lambda};
}

// The parents' mean and deviation, and their children.
struct Species {
  Species(const VectorArg& start, double deviation, Sizes sizes)
      : mean(start),
        sigma(deviation),
        X(start.size(), sizes.lambda),
        values(sizes.lambda),
        deviations(sizes.lambda),
        order(static_cast<std::size_t>(sizes.lambda)),
        mu(sizes.mu) {}

  void breed(bool selfAdaptation, Rng& rng) {
    const double tau = selfAdaptation ? 1 / std::sqrt(2. * static_cast<double>(mean.size())) : 0;
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      deviations[i] = selfAdaptation ? sigma * std::exp(tau * rng.normal()) : sigma;
      for (Eigen::Index k = 0; k < X.rows(); ++k) X(k, i) = mean[k] + deviations[i] * rng.normal();
    }
  }

  void select() {
    const auto key = [&](int i) {
      return std::isfinite(values[i]) ? values[i] : std::numeric_limits<double>::infinity();
    };
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](int a, int b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    mean.setZero();
    double logSigma = 0;
    for (int i = 0; i < mu; ++i) {
      const int parent = order[static_cast<std::size_t>(i)];
      mean += X.col(parent) / mu;
      logSigma += std::log(deviations[parent] / sigma) / mu;
    }
    sigma *= std::exp(logSigma);
  }

  Eigen::VectorXd mean;
  double sigma;
  Eigen::MatrixXd X;  // n x lambda
  Eigen::VectorXd values, deviations;
  std::vector<int> order;
  int mu;
};

}  // namespace

SearchResult minimizeByEvolution(const BatchObjective& f, const VectorArg& start, double deviation, Rng& rng,
                                 const EvolutionStrategyOptions& options) {
  internal::requireSearch(kEvolution, start, deviation, options.target, options.maxEvaluations);
  requirePositive("evolution strategy: smallest step", options.smallestStep);
  const Sizes sizes = sizesOf(start.size(), options);
  Species species(start, deviation, sizes);
  SearchResult result;
  result.x = start;
  std::optional<SearchStatus> status;
  while (!status) {
    if (result.evaluations + sizes.lambda > options.maxEvaluations) {
      status = SearchStatus::kBudgetSpent;
      break;
    }
    species.breed(options.selfAdaptation, rng);
    f(species.X, species.values);
    for (Eigen::Index i = 0; i < species.X.cols(); ++i) result.add(species.X.col(i), species.values[i]);
    ++result.iterations;
    if (species.values.array().isFinite().any()) species.select();
    if (result.value <= options.target)
      status = SearchStatus::kTargetReached;
    else if (!(species.sigma > options.smallestStep * deviation))  // also 0 and, after that, nan
      status = SearchStatus::kSmallSteps;
    else if (species.sigma > 1e100 * deviation)
      status = SearchStatus::kDiverged;
  }
  result.end(*status);
  return result;
}

}  // namespace rex
