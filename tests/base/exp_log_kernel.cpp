#include "base/exp_log_kernel.h"

#include "base/lane_math.h"

namespace rex {
namespace {

template <class T>
void exponentialOfAll(const double* numbers, int count, double* out) {
  for (int i = 0; i < count; i += kLanesOf<T>) store(exponential(load<T>(numbers + i)), out + i);
}

template <class T>
void logarithmOfAll(const double* numbers, int count, double* out) {
  for (int i = 0; i < count; i += kLanesOf<T>) store(logarithm(load<T>(numbers + i)), out + i);
}

}  // namespace

template <int kLanes>
ExpLogKernel ExpLogKernel::compiled() {
  return {&exponentialOfAll<InLanes<kLanes>>, &logarithmOfAll<InLanes<kLanes>>};
}
template ExpLogKernel ExpLogKernel::compiled<REX_LANES>();

}  // namespace rex
