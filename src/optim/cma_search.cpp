#include "optim/cma_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "optim/search_result_internal.h"

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

namespace {

constexpr double kMostNumbers = 1e7;  // of a generation: 80 MB

void requireSound(const VectorArg& low, const VectorArg& high, const RestartOptions& options) {
  requireSize("restarts: upper ends of the box", high.size(), low.size());
  requireFinite("restarts: lower ends of the box", low);
  requireFinite("restarts: upper ends of the box", high);
  for (Eigen::Index i = 0; i < low.size(); ++i)
    if (low[i] > high[i])
      throw Error({.what = fmt::format("restarts: coordinate {} of the box", i),
                   .found = fmt::format("{:g} to {:g}", low[i], high[i]),
                   .wanted = "the lower end first"});
  if (!(options.growth >= 1 && options.growth <= 100))
    throw Error({.what = "restarts: growth of the population",
                 .found = fmt::format("{:g}", options.growth),
                 .wanted = "1 to 100"});
  requireCount("restarts", options.maxRestarts, 0);
}

Eigen::VectorXd pointBetween(const VectorArg& low, const VectorArg& high, Rng& rng) {
  Eigen::VectorXd x(low.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = rng.uniform(low[i], high[i]);
  return x;
}

void addRun(RestartResult& all, SearchResult run) {
  if (run.value < all.value || all.runs.empty()) {
    all.value = run.value;
    all.x = run.x;
  }
  all.evaluations += run.evaluations;
  all.iterations += run.iterations;
  all.invalid += run.invalid;
  all.runs.push_back(std::move(run));
}

}  // namespace

SearchResult minimizeByCma(const BatchObjective& f, const VectorArg& start, const VectorArg& deviations,
                           Rng& rng, const CmaOptions& options, const CmaLimits& limits) {
  CmaEs es(start, deviations, options);
  CmaTermination termination(es, limits);
  Eigen::MatrixXd X(es.dimension(), es.lambda());
  Eigen::VectorXd values(es.lambda());
  std::optional<SearchStatus> status;
  if (es.lambda() > limits.maxEvaluations) status = SearchStatus::kBudgetSpent;
  while (!status) {
    es.sample(X, rng);
    f(X, values);
    es.update(X, values);
    status = termination.check(es, values);
  }
  SearchResult result = es.result();
  result.end(*status);
  return result;
}

RestartResult minimizeByRestarts(const BatchObjective& f, const VectorArg& low, const VectorArg& high,
                                 const VectorArg& deviations, Rng& rng, const RestartOptions& options) {
  requireSound(low, high, options);
  const auto n = static_cast<double>(low.size());
  RestartResult all;
  CmaOptions now = options.first;
  CmaLimits limits = options.limits;
  for (int run = 0; run <= options.maxRestarts; ++run) {
    const Eigen::VectorXd start = pointBetween(low, high, rng);
    now.lambda = CmaEs(start, deviations, now).lambda();
    addRun(all, minimizeByCma(f, start, deviations, rng, now, limits));
    all.end(all.runs.back().status);
    if (all.status == SearchStatus::kTargetReached || all.status == SearchStatus::kBudgetSpent) break;
    limits.maxEvaluations = options.limits.maxEvaluations - all.evaluations;
    const double larger = std::min(kMostNumbers / n, std::ceil(now.lambda * options.growth));
    now.lambda = std::max(now.lambda, static_cast<int>(larger));
    if (now.mu > 0)
      now.mu = static_cast<int>(std::min<double>(now.lambda, std::ceil(now.mu * options.growth)));
    if (now.lambda > limits.maxEvaluations) {
      all.end(SearchStatus::kBudgetSpent);
      break;
    }
  }
  return all;
}

}  // namespace rex
