#include "base/pack_kernel.h"

#include "base/pack.h"

namespace rex {
namespace {

template <class T>
void apply(const double* x, const double* y, double* results) {
  const T a = load<T>(x), b = load<T>(y), one(1.0), zero(0.0);
  const T all[PackKernel::kOperations] = {a + b,
                                          a - b,
                                          a * b,
                                          a / b,
                                          -a,
                                          select(a < b, one, zero),
                                          select(a > b, one, zero),
                                          select(a <= b, one, zero),
                                          select(a >= b, one, zero),
                                          squareRoot(a),
                                          smaller(a, b),
                                          larger(a, b),
                                          absolute(a),
                                          clamped(a, -one, b),
                                          select(a < b, a, b)};
  for (int k = 0; k < PackKernel::kOperations; ++k) {
    double lanes[kLanesOf<T>];
    store(all[k], lanes);
    for (int i = 0; i < kLanesOf<T>; ++i) results[PackKernel::kOperations * i + k] = lanes[i];
  }
}

template <class T>
void applyToAll(const double* x, const double* y, int count, double* results) {
  for (int i = 0; i < count; i += kLanesOf<T>) apply<T>(x + i, y + i, results + PackKernel::kOperations * i);
}

}  // namespace

template <int kLanes>
PackKernel PackKernel::compiled() {
  return {&applyToAll<InLanes<kLanes>>};
}
template PackKernel PackKernel::compiled<REX_LANES>();

}  // namespace rex
