#include "base/pack.h"
#include "estimation/rank_two_kernel_internal.h"

namespace rex::internal {
namespace {

template <class T>
inline void subtractSome(double uj, double vj, const double* u, const double* v, double* to) {
  store(load<T>(to) - (T(uj) * load<T>(u) + T(vj) * load<T>(v)), to);
}

// Two columns at once, so that u and v are loaded half as often.
template <class T>
void subtractSquares(const double* u, const double* v, long n, double* matrix, long stride) {
  constexpr long kLanes = kLanesOf<T>;
  long j = 0;
  for (; j + 1 < n; j += 2) {
    double *first = matrix + j * stride, *second = first + stride;
    subtractSome<double>(u[j], v[j], u + j, v + j, first + j);
    long i = j + 1;
    for (; i + kLanes <= n; i += kLanes) {
      subtractSome<T>(u[j], v[j], u + i, v + i, first + i);
      subtractSome<T>(u[j + 1], v[j + 1], u + i, v + i, second + i);
    }
    for (; i < n; ++i) {
      subtractSome<double>(u[j], v[j], u + i, v + i, first + i);
      subtractSome<double>(u[j + 1], v[j + 1], u + i, v + i, second + i);
    }
  }
  if (j < n) subtractSome<double>(u[j], v[j], u + j, v + j, matrix + j * stride + j);
}

}  // namespace

template <int kLanes>
RankTwoKernel RankTwoKernel::compiled() {
  return {.subtract = subtractSquares<InLanes<kLanes>>};
}
template RankTwoKernel RankTwoKernel::compiled<REX_LANES>();

}  // namespace rex::internal
