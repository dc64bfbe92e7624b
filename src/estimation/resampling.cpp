#include "estimation/resampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/weights_kernel_internal.h"

namespace rex {
namespace {

// The weights divided by the largest, so that no sum of them overflows or vanishes.
struct ScaledWeights {
  Eigen::VectorXd weights;
  internal::WeightsKernel::Sums sums;
};

ScaledWeights scaledWeights(const VectorArg& weights) {
  const auto kernel = kernelFor<internal::WeightsKernel>(cpuLanes());
  const double largest = kernel.largest(weights.data(), weights.size(), 0);
  if (std::isnan(largest)) requireNotNegative("weights of particles", weights);  // throws
  if (!(largest > 0)) throw Error({.what = "weights", .found = "only zeros", .wanted = "a positive one"});
  ScaledWeights scaled{Eigen::VectorXd(weights.size()), {}};
  scaled.sums = kernel.divide(weights.data(), largest, weights.size(), scaled.weights.data());
  return scaled;
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

// Parent i has the children k with k + start below the sum of the weights up to i, in slices. All are written
// four at a time, as most parents have fewer: this leaves the CPU no branches to predict.
void drawSystematic(const Eigen::VectorXd& weights, int size, int count, double slice, double start,
                    std::vector<int>& parents) {
  constexpr int kAtOnce = 4;
  parents.resize(static_cast<std::size_t>(count) + kAtOnce);
  double upTo = 0;
  int next = 0;
  for (int i = 0; i < size; ++i) {
    upTo += weights[i];
    const int end = i + 1 == size ? count : std::min(count, static_cast<int>(upTo / slice + (1 - start)));
    int* child = parents.data() + next;
    for (int k = 0; k < kAtOnce; ++k) child[k] = i;
    for (int k = next + kAtOnce; k < end; ++k) parents[static_cast<std::size_t>(k)] = i;
    next = end;
  }
  parents.resize(static_cast<std::size_t>(count));
}

// Whole parts are certain; the rest is drawn at random.
void drawResidual(const Eigen::VectorXd& weights, int size, int count, double total, Rng& rng,
                  std::vector<int>& parents) {
  // A share that is a whole number but for rounding is one.
  const double shares = count / total * (1 + 1e-12);
  double left = 0;
  int certain = 0;
  for (int i = 0; i < size; ++i) {
    const double share = shares * weights[i];
    const int whole = static_cast<int>(share);
    certain += whole;
    left += share - whole;
  }
  // Rounding may make the whole parts one too many, as for weights of just 1 / 3.
  const int drawn = std::max(0, count - certain);
  const std::vector<double> places = ascendingUniforms(drawn, rng);
  double upTo = 0;
  std::size_t next = 0;
  for (int i = 0; i < size; ++i) {
    const double share = shares * weights[i];
    int children = static_cast<int>(share);
    upTo += share - children;
    for (; next < places.size() && (left * places[next] < upTo || i + 1 == size); ++next) ++children;
    for (int k = 0; k < children; ++k) parents.push_back(i);
  }
  parents.resize(static_cast<std::size_t>(count));
}

}  // namespace

void resample(const VectorArg& weights, int count, Resampling how, Rng& rng, std::vector<int>& parents) {
  const auto [scaled, sums] = scaledWeights(weights);
  const double total = sums.plain;
  requireCount("particles to draw", count, 0);
  // Up to the last weight that is not zero: rounding must not lead beyond.
  int size = static_cast<int>(scaled.size());
  while (scaled[size - 1] == 0) --size;
  const double slice = total / count;
  if (how == Resampling::kSystematic)  // leaves its children where they are: clearing would take a pass
    return drawSystematic(scaled, size, count, slice, rng.uniform(), parents);
  parents.clear();
  parents.reserve(static_cast<std::size_t>(count));
  const auto weightOf = [&scaled = scaled](int i) { return scaled[i]; };
  const auto take = [&](int i) { parents.push_back(i); };
  switch (how) {
    case Resampling::kMultinomial:
      return drawEachAlone(size, count, total, weightOf, rng, take);
    case Resampling::kResidual:
      return drawResidual(scaled, size, count, total, rng, parents);
    case Resampling::kStratified:
      return drawAscending(
          size, count, weightOf, [&](int k) { return slice * (k + rng.uniform()); }, take);
    case Resampling::kSystematic:
      break;
  }
}

std::vector<int> resampled(const VectorArg& weights, int count, Resampling how, Rng& rng) {
  std::vector<int> parents;
  resample(weights, count, how, rng, parents);
  return parents;
}

double effectiveSampleSize(const VectorArg& weights) {
  const auto sums = scaledWeights(weights).sums;
  return sums.plain * sums.plain / sums.squared;
}

int adaptiveSampleSize(int cells, double error, double quantile) {
  requireCount("occupied cells", cells, 1);
  requirePositive("error", error);
  requirePositive("quantile", quantile);
  if (cells == 1) return 1;
  const double k = cells - 1, part = 2 / (9 * k);
  const double root = 1 - part + std::sqrt(part) * quantile;
  const double count = std::ceil(k / (2 * error) * root * root * root);
  return static_cast<int>(std::clamp(count, 1., static_cast<double>(std::numeric_limits<int>::max())));
}

}  // namespace rex
