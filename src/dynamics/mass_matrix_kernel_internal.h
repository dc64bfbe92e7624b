#pragma once

#include "scene/link.h"

namespace rex::internal {

/// The mass matrix of one posture in plain numbers, both halves: entry (i, k) at M[i + stride k].
struct MassMatrixKernel {
  using Compute = void (*)(const Link* links, int linkCount, const double* q, void* memory, double* M,
                           long stride, int nv);
  Compute one;
  int numbersPerLink, numbersPerFreedom;  ///< of memory; see roomFor()

  template <int kLanes>
  static MassMatrixKernel compiled();
};

}  // namespace rex::internal
