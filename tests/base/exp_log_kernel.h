#pragma once

namespace rex {

/// What exp_log_kernel.cpp computes with 1, 2 or 4 lanes, of `count` numbers, a multiple of 4.
struct ExpLogKernel {
  void (*exponentials)(const double* numbers, int count, double* out);
  void (*logarithms)(const double* numbers, int count, double* out);

  template <int kLanes>
  static ExpLogKernel compiled();
};

}  // namespace rex
