#include "estimation/resampling.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/rng.h"

namespace rex {
namespace {

double requireWeights(const VectorArg& weights) {
  for (Eigen::Index i = 0; i < weights.size(); ++i) {
    if (weights[i] >= 0 && std::isfinite(weights[i])) continue;
    throw Error({.what = fmt::format("weight of particle {}", i),
                 .found = fmt::format("{:g}", weights[i]),
                 .wanted = "a finite number, zero or more"});
  }
  const double sum = weights.sum();
  if (!(sum > 0)) throw Error({.what = "weights", .found = "only zeros", .wanted = "a positive one"});
  return sum;
}

// Calls take(i) for each of `count` ascending places place(k) in [0, total), with the weight it falls into.
template <class WeightOf, class PlaceOf, class Take>
void drawAscending(int size, int count, const WeightOf& weightOf, const PlaceOf& placeOf, const Take& take) {
  int i = 0;
  double upTo = weightOf(0);
  for (int k = 0; k < count; ++k) {
    const double place = placeOf(k);
    while (place >= upTo && i + 1 < size) upTo += weightOf(++i);
    take(i);
  }
}

// `count` uniform numbers in ascending order without sorting: ratios of sums of exponential gaps.
std::vector<double> ascendingUniforms(int count, Rng& rng) {
  std::vector<double> places(static_cast<std::size_t>(count));
  double sum = 0;
  for (double& place : places) place = sum -= std::log1p(-rng.uniform());
  sum -= std::log1p(-rng.uniform());
  for (double& place : places) place /= sum;
  return places;
}

template <class WeightOf, class Take>
void drawEachAlone(int size, int count, double total, const WeightOf& weightOf, Rng& rng, const Take& take) {
  const std::vector<double> places = ascendingUniforms(count, rng);
  drawAscending(
      size, count, weightOf, [&](int k) { return total * places[static_cast<std::size_t>(k)]; }, take);
}

// Whole parts for certain; what is left by chance.
template <class WeightOf>
void drawResidual(int size, int count, double total, const WeightOf& weightOf, Rng& rng,
                  std::vector<int>& parents) {
  const auto share = [&](int i) { return count * (weightOf(i) / total); };
  double left = 0;
  int certain = 0;
  for (int i = 0; i < size; ++i) {
    const double whole = std::floor(share(i));
    certain += static_cast<int>(whole);
    left += share(i) - whole;
  }
  // Rounding may make the whole parts one too many, as for weights of just 1 / 3.
  const int drawn = std::max(0, count - certain);
  const std::vector<double> places = ascendingUniforms(drawn, rng);
  double upTo = 0;
  std::size_t next = 0;
  for (int i = 0; i < size; ++i) {
    const double whole = std::floor(share(i));
    upTo += share(i) - whole;
    int children = static_cast<int>(whole);
    for (; next < places.size() && (left * places[next] < upTo || i + 1 == size); ++next) ++children;
    parents.insert(parents.end(), static_cast<std::size_t>(children), i);
  }
  parents.resize(static_cast<std::size_t>(count));
}

}  // namespace

void resample(const VectorArg& weights, int count, Resampling how, Rng& rng, std::vector<int>& parents) {
  const double total = requireWeights(weights);
  if (count < 0)
    throw Error({.what = "particles to draw", .found = fmt::format("{}", count), .wanted = "zero or more"});
  parents.clear();
  parents.reserve(static_cast<std::size_t>(count));
  // Up to the last weight that is not zero: rounding must not lead beyond.
  int size = static_cast<int>(weights.size());
  while (weights[size - 1] == 0) --size;
  const double slice = total / count;
  const auto weightOf = [&](int i) { return weights[i]; };
  const auto take = [&](int i) { parents.push_back(i); };
  switch (how) {
    case Resampling::kMultinomial:
      return drawEachAlone(size, count, total, weightOf, rng, take);
    case Resampling::kResidual:
      return drawResidual(size, count, total, weightOf, rng, parents);
    case Resampling::kStratified:
      return drawAscending(
          size, count, weightOf, [&](int k) { return slice * (k + rng.uniform()); }, take);
    case Resampling::kSystematic: {
      const double start = rng.uniform();
      return drawAscending(
          size, count, weightOf, [&](int k) { return slice * (k + start); }, take);
    }
  }
}

std::vector<int> resampled(const VectorArg& weights, int count, Resampling how, Rng& rng) {
  std::vector<int> parents;
  resample(weights, count, how, rng, parents);
  return parents;
}

double effectiveSampleSize(const VectorArg& weights) {
  // Divided by the largest, so that squares of small weights do not vanish.
  const double total = requireWeights(weights), largest = weights.maxCoeff();
  return (total / largest) * (total / largest) / (weights / largest).squaredNorm();
}

int adaptiveSampleSize(int cells, double error, double quantile) {
  if (cells < 1)
    throw Error({.what = "occupied cells", .found = fmt::format("{}", cells), .wanted = "one or more"});
  if (!(error > 0))
    throw Error({.what = "error", .found = fmt::format("{:g}", error), .wanted = "more than 0"});
  if (!(quantile > 0))
    throw Error({.what = "quantile", .found = fmt::format("{:g}", quantile), .wanted = "more than 0"});
  if (cells == 1) return 1;
  const double k = cells - 1, part = 2 / (9 * k);
  const double root = 1 - part + std::sqrt(part) * quantile;
  return static_cast<int>(std::ceil(k / (2 * error) * root * root * root));
}

}  // namespace rex
