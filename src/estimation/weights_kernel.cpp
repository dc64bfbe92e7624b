#include "base/lane_math.h"
#include "estimation/weights_kernel_internal.h"

namespace rex::internal {
namespace {

constexpr int kParts = 4;

/// Four partial sums.
template <class T>
struct PartialSums {
  T part[kParts / kLanesOf<T>] = {};

  void add(int k, const T& numbers) { part[k / kLanesOf<T>] = part[k / kLanesOf<T>] + numbers; }
  /// With the numbers that are left, fewer than four.
  double with(const double* rest, long count) const {
    double sums[kParts];
    __builtin_memcpy(sums, part, sizeof sums);
    double even = sums[0] + sums[2], odd = sums[1] + sums[3];
    if (count >= 2) {
      even += rest[0];
      odd += rest[1];
    }
    return count % 2 == 0 ? even + odd : even + odd + rest[count - 1];
  }
};

template <class T>
double largestOf(const double* numbers, long count, double least) {
  const double infinity = __builtin_inf();
  T largest(-infinity);
  auto areWithin = T(0.0) <= T(0.0);
  long i = 0;
  for (; i + kLanesOf<T> <= count; i += kLanesOf<T>) {
    const T x = load<T>(numbers + i);
    areWithin = areWithin & (x >= T(least)) & (x < T(infinity));
    largest = larger(x, largest);
  }
  double lanes[kLanesOf<T>], result = -infinity;
  store(largest, lanes);
  for (const double x : lanes) result = larger(x, result);
  bool isWithin = all(areWithin);
  for (; i < count; ++i) {
    isWithin = isWithin && numbers[i] >= least && numbers[i] < infinity;
    result = larger(numbers[i], result);
  }
  return isWithin ? result : __builtin_nan("");
}

template <class T>
double exponentialsOf(const double* logWeights, double largest, long count, double* weights) {
  PartialSums<T> sums;
  long i = 0;
  for (; i + kParts <= count; i += kParts)
    for (int k = 0; k < kParts; k += kLanesOf<T>) {
      const T weight = exponential(load<T>(logWeights + i + k) - T(largest));
      store(weight, weights + i + k);
      sums.add(k, weight);
    }
  for (long k = i; k < count; ++k) weights[k] = exponential(logWeights[k] - largest);
  return sums.with(weights + i, count - i);
}

template <class T>
WeightsKernel::Sums quotientsOf(const double* weights, double divisor, long count, double* quotients) {
  PartialSums<T> sums, squaredSums;
  long i = 0;
  for (; i + kParts <= count; i += kParts)
    for (int k = 0; k < kParts; k += kLanesOf<T>) {
      const T quotient = load<T>(weights + i + k) / T(divisor);
      store(quotient, quotients + i + k);
      sums.add(k, quotient);
      squaredSums.add(k, quotient * quotient);
    }
  double squares[kParts] = {};
  for (long k = i; k < count; ++k) {
    quotients[k] = weights[k] / divisor;
    squares[k - i] = quotients[k] * quotients[k];
  }
  return {sums.with(quotients + i, count - i), squaredSums.with(squares, count - i)};
}

}  // namespace

template <int kLanes>
WeightsKernel WeightsKernel::compiled() {
  using T = InLanes<kLanes>;
  return {.largest = largestOf<T>, .exponentials = exponentialsOf<T>, .divide = quotientsOf<T>};
}
template WeightsKernel WeightsKernel::compiled<REX_LANES>();

}  // namespace rex::internal
