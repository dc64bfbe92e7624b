#include "optim/bayesian_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "optim/box_descent_internal.h"
#include "optim/search_result_internal.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kBayes = "Bayesian search";

// h = phi(z) + z Phi(z), the expected improvement in deviations, as a logarithm; and Phi / h and phi / h, by
// which it changes. For z far below zero the sum cancels, and phi(z) / z^2 (1 - 3/z^2 + 15/z^4 ...) is used.
struct Improvement {
  double logH = 0, cdfShare = 0, densityShare = 0;
};

Improvement improvementAt(double z) {
  constexpr double kLogRootTwoPi = 0.91893853320467274;
  if (z > -30) {
    const double density = std::exp(-z * z / 2 - kLogRootTwoPi);
    const double cdf = std::erfc(-z / std::numbers::sqrt2) / 2;
    const double h = density + z * cdf;
    return {std::log(h), cdf / h, density / h};
  }
  const double s = 1 / (z * z);
  const double series = s * (1 - s * (3 - s * (15 - s * (105 - s * 945))));
  return {-z * z / 2 - kLogRootTwoPi + std::log(series), (1 - 1 / series) / z, 1 / series};
}

// n points, of which each coordinate visits each of n equal parts of its range once.
MatrixXd latinHypercube(const VectorXd& low, const VectorXd& high, Index n, Rng& rng) {
  MatrixXd X(low.size(), n);
  std::vector<int> order(static_cast<std::size_t>(n));
  for (Index c = 0; c < low.size(); ++c) {
    std::iota(order.begin(), order.end(), 0);
    for (int i = static_cast<int>(n); i > 1; --i)
      std::swap(order[static_cast<std::size_t>(i - 1)], order[static_cast<std::size_t>(rng.index(i))]);
    for (Index i = 0; i < n; ++i) {
      const double share = (order[static_cast<std::size_t>(i)] + rng.uniform()) / static_cast<double>(n);
      X(c, i) = low[c] + share * (high[c] - low[c]);
    }
  }
  return X;
}

}  // namespace

double logExpectedImprovement(double mean, double deviation, double best) {
  requirePositive("expected improvement: deviation", deviation);
  return std::log(deviation) + improvementAt((best - mean) / deviation).logH;
}

BayesianSearch::BayesianSearch(const VectorArg& low, const VectorArg& high, const BayesianOptions& options)
    : low_(low), high_(high), options_(options) {
  requireCount("Bayesian search: coordinates of the box", low_.size(), 1);
  requireSize("Bayesian search: upper bounds", high_.size(), low_.size());
  requireFinite("Bayesian search: lower bounds", low_);
  requireFinite("Bayesian search: upper bounds", high_);
  for (Index c = 0; c < low_.size(); ++c)
    internal::requireSearchOption(low_[c] < high_[c], kBayes, "upper bound", high_[c],
                                  fmt::format("more than the lower one, {:g}", low_[c]).c_str());
  requirePositive("Bayesian search: confidence", options_.confidence);
  requireCount("Bayesian search: first samples", options_.firstSamples, 0);
  if (options_.firstSamples == 0) options_.firstSamples = 2 * static_cast<int>(low_.size()) + 2;
  requireCount("Bayesian search: first samples", options_.firstSamples, 2);
  X_.resize(low_.size(), 0);
}

VectorXd BayesianSearch::next(Rng& rng) {
  if (!process_) {
    if (first_.size() == 0) first_ = latinHypercube(low_, high_, options_.firstSamples, rng);
    return first_.col(X_.cols()).cwiseMax(low_).cwiseMin(high_);
  }
  // The best of many random points, half of them near the best one, and what a few of these lead to.
  constexpr int kRefined = 4;
  const Index n = low_.size();
  const int count = 200 + 50 * static_cast<int>(n);
  const VectorXd width = high_ - low_;
  std::vector<std::pair<double, VectorXd>> candidates;
  for (int i = 0; i < count; ++i) {
    VectorXd x(n);
    const double spread = i % 4 == 1 ? 0.1 : 0.01;
    for (Index c = 0; c < n; ++c)
      x[c] = i % 2 == 0 ? rng.uniform(low_[c], high_[c]) : best_[c] + spread * width[c] * rng.normal();
    x = x.cwiseMax(low_).cwiseMin(high_);
    const double hope = acquisition(x);
    candidates.emplace_back(hope, std::move(x));
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  // In units of the box, in which all coordinates count alike.
  const auto loss = [&](const VectorXd& share, VectorXd& gradient) {
    const double hope = acquisition(VectorXd(low_ + share.cwiseProduct(width)), &gradient);
    gradient = -gradient.cwiseProduct(width);
    return -hope;
  };
  double most = -std::numeric_limits<double>::infinity();
  VectorXd found = candidates.front().second;
  for (int i = 0; i < kRefined; ++i) {
    const VectorXd share = (candidates[static_cast<std::size_t>(i)].second - low_).cwiseQuotient(width);
    const internal::BoxMinimum peak = internal::minimizeInBox(
        loss, share, VectorXd::Zero(n), VectorXd::Ones(n), 1e-6, 40 + 10 * static_cast<int>(n));
    if (!(-peak.value > most)) continue;
    most = -peak.value;
    found = (low_ + peak.x.cwiseProduct(width)).cwiseMax(low_).cwiseMin(high_);
  }
  return found;
}

void BayesianSearch::add(const VectorArg& x, double value) {
  requireSize("Bayesian search: point", x.size(), low_.size());
  if (!((x.array() >= low_.array()).all() && (x.array() <= high_.array()).all()))
    throw Error({.what = "Bayesian search: point", .found = "outside of the box", .wanted = "within bounds"});
  X_.conservativeResize(Eigen::NoChange, X_.cols() + 1);
  X_.rightCols(1) = x;
  y_.conservativeResize(X_.cols());
  y_[y_.size() - 1] = value;
  if (X_.cols() >= options_.firstSamples) learn();
  if (options_.isNoisy && process_) {
    bestValue_ = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < X_.cols(); ++i) {
      const double mean = process_->predict(X_.col(i)).mean;
      if (!std::isfinite(y_[i]) || !(mean < bestValue_)) continue;
      bestValue_ = mean;
      best_ = X_.col(i);
    }
  } else if (std::isfinite(value) && value < bestValue_) {
    bestValue_ = value;
    best_ = x;
  }
  if (best_.size() == 0) best_ = x;
}

// Parameters are fitted again for each of the first points, then whenever their number has grown by a tenth.
void BayesianSearch::learn() {
  VectorXd values = y_;
  double worst = -std::numeric_limits<double>::infinity();
  for (const double value : y_)
    if (std::isfinite(value)) worst = std::max(worst, value);
  for (double& value : values)
    if (!std::isfinite(value)) value = std::isfinite(worst) ? worst : 0;
  if (process_ && 10 * X_.cols() < 11 * lastFit_) {
    process_ = GaussianProcess(X_, std::move(values), process_->parameters(), options_.kernel);
    return;
  }
  GaussianFitOptions fit{.kernel = options_.kernel, .isNoisy = options_.isNoisy};
  std::optional<GaussianProcess> fitted = fittedGaussianProcess(X_, values, fit);
  if (process_) {  // a maximum of the likelihood is local: the better one of two
    fit.start = process_->parameters();
    std::optional<GaussianProcess> again = fittedGaussianProcess(X_, values, fit);
    if (again->logLikelihood() > fitted->logLikelihood()) fitted = std::move(again);
  }
  process_ = std::move(fitted);
  lastFit_ = X_.cols();
}

double BayesianSearch::acquisition(const VectorArg& x) const {
  if (!process_)
    throw Error({.what = "Bayesian search: acquisition",
                 .found = fmt::format("{} points", X_.cols()),
                 .wanted = fmt::format("{} before there is a model", options_.firstSamples)});
  return acquisition(x, nullptr);
}

double BayesianSearch::acquisition(const VectorArg& x, VectorXd* gradient) const {
  const GaussianPrediction f = process_->predict(x);
  if (options_.acquisition == Acquisition::kConfidenceBound) {
    if (gradient) *gradient = options_.confidence * f.deviationGradient - f.meanGradient;
    return options_.confidence * f.deviation - f.mean;
  }
  const double best = std::isfinite(bestValue_) ? bestValue_ : f.mean;
  const Improvement improvement = improvementAt((best - f.mean) / f.deviation);
  if (gradient)
    *gradient = (improvement.densityShare * f.deviationGradient - improvement.cdfShare * f.meanGradient) /
                f.deviation;
  return std::log(f.deviation) + improvement.logH;
}

SearchResult minimizeByBayes(const Objective& f, const VectorArg& low, const VectorArg& high, Rng& rng,
                             const BayesianOptions& options) {
  internal::requireSearchOption(options.target < std::numeric_limits<double>::infinity(), kBayes, "target",
                                options.target, "a number below infinity");
  requireCount("Bayesian search: budget of evaluations", options.maxEvaluations, 1);
  BayesianSearch search(low, high, options);
  SearchResult result;
  result.x = (low + high) / 2;
  while (result.evaluations < options.maxEvaluations && !(result.value <= options.target)) {
    const VectorXd x = search.next(rng);
    const double value = f(x);
    search.add(x, value);
    result.add(x, value);
    ++result.iterations;
    if (!options.isNoisy || !std::isfinite(search.bestValue())) continue;
    result.x = search.best();
    result.value = search.bestValue();
  }
  result.end(result.value <= options.target ? SearchStatus::kTargetReached : SearchStatus::kBudgetSpent);
  return result;
}

}  // namespace rex
