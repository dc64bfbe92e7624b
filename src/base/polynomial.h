#pragma once

#include "base/pack.h"

namespace rex {
namespace {

/// factors[0] + factors[1] z + factors[2] z^2 + ..., for kernels; see base/pack.h.
template <int kCount, class T>
inline T polynomial(const double (&factors)[kCount], const T& z) {
  T sum(factors[kCount - 1]);
  for (int i = kCount - 2; i >= 0; --i) sum = T(factors[i]) + z * sum;
  return sum;
}

}  // namespace
}  // namespace rex
