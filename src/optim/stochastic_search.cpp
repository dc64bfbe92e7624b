#include "optim/stochastic_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Eigenvalues>

#include "base/require.h"
#include "optim/search_result_internal.h"

namespace rex {

AnnealingResult minimizeByAnnealing(const Objective& f, const VectorArg& start, Rng& rng,
                                    const AnnealingOptions& options) {
  constexpr const char* kName = "annealing";
  internal::requireSearch(kName, start, options.deviation, options.target, options.maxEvaluations);
  requirePositive("annealing: first temperature", options.firstTemperature);
  internal::requireSearchOption(
      options.lastTemperature > 0 && options.lastTemperature <= options.firstTemperature, kName,
      "last temperature", options.lastTemperature, "a positive number, at most the first");

  AnnealingResult result;
  result.x = result.last = start;
  Eigen::VectorXd x(start.size());
  const auto evaluate = [&](const Eigen::VectorXd& point) {
    const double found = f(point);
    result.add(point, found);
    return std::isfinite(found) ? found : std::numeric_limits<double>::infinity();
  };
  double value = evaluate(result.last);
  const auto steps = static_cast<double>(options.maxEvaluations);
  while (result.value > options.target && result.evaluations < options.maxEvaluations) {
    const double cooled = static_cast<double>(result.evaluations) / steps;
    const double temperature =
        options.firstTemperature * std::pow(options.lastTemperature / options.firstTemperature, cooled);
    for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = result.last[i] + options.deviation * rng.normal();
    const double next = evaluate(x);
    ++result.iterations;
    const bool isLower = next <= value;  // also if there is no value yet
    if (!isLower && !(rng.uniform() < std::exp((value - next) / temperature))) continue;
    result.last = x;
    value = next;
    ++result.accepted;
  }
  result.end(result.value <= options.target ? SearchStatus::kTargetReached : SearchStatus::kBudgetSpent);
  return result;
}

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
