#include "optim/cma_termination.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

constexpr std::size_t kLongestMemory = 20'000;

}  // namespace

CmaTermination::CmaTermination(const CmaEs& es, const CmaLimits& limits)
    : limits_(limits), firstSigma_(es.sigma()), firstAxis_(es.sigma() * es.axisLengths().maxCoeff()) {
  if (!(limits.target < std::numeric_limits<double>::infinity()))
    throw Error({.what = "CMA-ES: target",
                 .found = fmt::format("{:g}", limits.target),
                 .wanted = "a number below infinity"});
  requireCount("CMA-ES: budget of evaluations", limits.maxEvaluations, 1);
  requirePositive("CMA-ES: smallest step", limits.smallestStep);
  requirePositive("CMA-ES: smallest difference", limits.smallestDifference);
  requirePositiveOrInfinite("CMA-ES: largest condition", limits.largestCondition);
  requirePositiveOrInfinite("CMA-ES: largest growth", limits.largestGrowth);
  const double generations = std::ceil(30. * es.dimension() / es.lambda());
  flatSpan_ = 10 + static_cast<std::size_t>(generations);
  stagnationSpan_ = std::min(kLongestMemory, 120 + static_cast<std::size_t>(generations));
  bests_.reserve(2 * kLongestMemory), medians_.reserve(2 * kLongestMemory);
  sorted_.reserve(std::max(kLongestMemory, static_cast<std::size_t>(es.lambda())));
  moved_.resize(es.dimension());
}

std::optional<SearchStatus> CmaTermination::check(const CmaEs& es, const VectorArg& values) {
  const SearchResult& result = es.result();
  if (result.value <= limits_.target) return SearchStatus::kTargetReached;
  if (result.evaluations + es.lambda() > limits_.maxEvaluations) return SearchStatus::kBudgetSpent;
  if (!values.array().isFinite().any()) return {};  // nothing was learnt
  remember(values);
  const double step = limits_.smallestStep * firstSigma_;
  if (es.sigma() * std::sqrt(es.covariance().diagonal().maxCoeff()) < step &&
      es.sigma() * es.path().cwiseAbs().maxCoeff() < step)
    return SearchStatus::kSmallSteps;
  if (isFlat(values)) return SearchStatus::kFlat;
  if (hasNoEffect(es)) return SearchStatus::kNoEffect;
  const double longest = es.axisLengths().maxCoeff(), shortest = es.axisLengths().minCoeff();
  if (longest * longest > limits_.largestCondition * shortest * shortest)
    return SearchStatus::kIllConditioned;
  if (es.sigma() * longest > limits_.largestGrowth * firstAxis_) return SearchStatus::kDiverged;
  if (isStagnating(es.generation())) return SearchStatus::kStagnated;
  return {};
}

void CmaTermination::remember(const VectorArg& values) {
  sorted_.clear();
  for (const double value : values)
    if (std::isfinite(value)) sorted_.push_back(value);
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::ranges::nth_element(sorted_, middle);
  for (auto* history : {&bests_, &medians_}) {
    if (history->size() < 2 * kLongestMemory) continue;
    history->erase(history->begin(), history->begin() + static_cast<std::ptrdiff_t>(kLongestMemory));
  }
  medians_.push_back(*middle);
  bests_.push_back(*std::min_element(sorted_.begin(), middle + 1));
}

bool CmaTermination::isFlat(const VectorArg& values) const {
  if (bests_.size() < flatSpan_ || !values.allFinite()) return false;
  const auto [low, high] =
      std::minmax_element(bests_.end() - static_cast<std::ptrdiff_t>(flatSpan_), bests_.end());
  return std::max(*high, values.maxCoeff()) - std::min(*low, values.minCoeff()) < limits_.smallestDifference;
}

// A tenth of a deviation along one of the axes in turn, and a fifth along every coordinate.
bool CmaTermination::hasNoEffect(const CmaEs& es) {
  const Eigen::Index axis = es.generation() % es.dimension();
  moved_ = es.mean() + 0.1 * es.sigma() * es.axisLengths()[axis] * es.axes().col(axis);
  if (moved_ == es.mean()) return true;
  moved_ = es.mean() + 0.2 * es.sigma() * es.covariance().diagonal().cwiseSqrt();
  return (moved_.array() == es.mean().array()).any();
}

double CmaTermination::medianOf(const std::vector<double>& history, std::size_t from, std::size_t count) {
  const auto begin = history.begin() + static_cast<std::ptrdiff_t>(from);
  sorted_.assign(begin, begin + static_cast<std::ptrdiff_t>(count));
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::ranges::nth_element(sorted_, middle);
  return *middle;
}

// Whether, over the last fifth of all generations, the first 30 % were as good as the last 30 %. Looking only
// now and then keeps the cost low.
bool CmaTermination::isStagnating(int generation) {
  const std::size_t all = bests_.size();
  const std::size_t fifth = static_cast<std::size_t>(generation) / 5;
  const std::size_t span = std::clamp(fifth, stagnationSpan_, kLongestMemory);
  if (all < span || generation % 20 != 0) return false;
  const std::size_t part = 3 * span / 10;
  for (const auto* history : {&bests_, &medians_})
    if (medianOf(*history, all - part, part) < medianOf(*history, all - span, part)) return false;
  return true;
}

}  // namespace rex
