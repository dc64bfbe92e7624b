#pragma once

namespace rex {

/// What pack_kernel.cpp computes with 1, 2 or 4 lanes.
struct PackKernel {
  /// Writes the results of all operations on each x[i], y[i], i < count (a multiple of 4), to
  /// results[kOperations * i] and on.
  static constexpr int kOperations = 15;
  void (*operations)(const double* x, const double* y, int count, double* results);

  template <int kLanes>
  static PackKernel compiled();
};

}  // namespace rex
