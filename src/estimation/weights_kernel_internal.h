#pragma once

namespace rex::internal {

/// What weights_kernel.cpp computes with 1, 2 or 4 lanes.
struct WeightsKernel {
  /// weights[i] = exp(logWeights[i] - largest), of log weights up to the largest.
  void (*exponentials)(const double* logWeights, double largest, long count, double* weights);

  template <int kLanes>
  static WeightsKernel compiled();
};

}  // namespace rex::internal
