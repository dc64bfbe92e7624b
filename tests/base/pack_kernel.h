#pragma once

namespace rex {

/// What pack_kernel.cpp computes with 1, 2 or 4 lanes.
struct PackKernel {
  /// Writes the results of all operations on each x[i], y[i], i < count (a multiple of 4), to
  /// results[kOperations * i] and on.
  static constexpr int kOperations = 15;
  void (*operations)(const double* x, const double* y, int count, double* results);
  /// Writes for each pack of lanes from the front whether x < y in any of them, and whether in all.
  void (*compare)(const double* x, const double* y, int count, bool* isAny, bool* isAll);

  template <int kLanes>
  static PackKernel compiled();
};

}  // namespace rex
