#include "base/exp_log.h"
#include "estimation/weights_kernel_internal.h"

namespace rex::internal {
namespace {

template <class T>
void exponentialsOf(const double* logWeights, double largest, long count, double* weights) {
  long i = 0;
  for (; i + kLanesOf<T> <= count; i += kLanesOf<T>)
    store(exponential(load<T>(logWeights + i) - T(largest)), weights + i);
  for (; i < count; ++i) weights[i] = exponential(logWeights[i] - largest);
}

}  // namespace

template <int kLanes>
WeightsKernel WeightsKernel::compiled() {
  return {.exponentials = exponentialsOf<InLanes<kLanes>>};
}
template WeightsKernel WeightsKernel::compiled<REX_LANES>();

}  // namespace rex::internal
