#pragma once

namespace rex {

/// What sin_cos_kernel.cpp computes with 1, 2 or 4 lanes.
struct SinCosKernel {
  /// Sine and cosine of `count` angles, a multiple of 4.
  void (*sinCos)(const double* angles, int count, double* sines, double* cosines);

  template <int kLanes>
  static SinCosKernel compiled();
};

}  // namespace rex
