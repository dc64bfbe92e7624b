#include "base/sin_cos_kernel.h"

#include "base/lane_math.h"

namespace rex {
namespace {

template <class T>
void takeAll(const double* angles, int count, double* sines, double* cosines) {
  for (int i = 0; i < count; i += kLanesOf<T>) {
    const SinCos<T> result = sinCos(load<T>(angles + i));
    store(result.sine, sines + i);
    store(result.cosine, cosines + i);
  }
}

}  // namespace

template <int kLanes>
SinCosKernel SinCosKernel::compiled() {
  return {&takeAll<InLanes<kLanes>>};
}
template SinCosKernel SinCosKernel::compiled<REX_LANES>();

}  // namespace rex
