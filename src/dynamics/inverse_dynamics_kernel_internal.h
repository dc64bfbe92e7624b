#pragma once

#include "dynamics/link_kernel_internal.h"

namespace rex::internal {

/// Inverse dynamics in plain numbers: given are accelerations, results are forces.
struct InverseDynamicsKernel {
  using Solve = void (*)(const DynamicsTask& task);
  Solve one;                              ///< of one state
  Solve block;                            ///< of DynamicsTask::kBlock states
  int numbersPerLink, numbersPerFreedom;  ///< of memory, per lane; the world counts as a link

  template <int kLanes>
  static InverseDynamicsKernel compiled();
};

}  // namespace rex::internal
