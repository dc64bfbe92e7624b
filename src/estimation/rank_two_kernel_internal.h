#pragma once

namespace rex::internal {

/// What rank_two_kernel.cpp computes with 1, 2 or 4 lanes.
struct RankTwoKernel {
  /// Subtracts u u^T + v v^T from the lower triangle of a matrix of size n, whose columns are `stride` apart.
  void (*subtract)(const double* u, const double* v, long n, double* matrix, long stride);

  template <int kLanes>
  static RankTwoKernel compiled();
};

}  // namespace rex::internal
