#pragma once

namespace rex::internal {

/// What weights_kernel.cpp computes with 1, 2 or 4 lanes. Sums are added up from four partial ones, each of
/// every fourth number, so that any number of lanes gives the same bits.
struct WeightsKernel {
  struct Sums {
    double plain, squared;
  };

  /// The largest of the numbers; not a number unless all are from `least` to below infinity.
  double (*largest)(const double* numbers, long count, double least);
  /// weights[i] = exp(logWeights[i] - largest), of log weights up to the largest. Returns the sum of the
  /// weights.
  double (*exponentials)(const double* logWeights, double largest, long count, double* weights);
  /// quotients[i] = weights[i] / divisor. Returns the sums of the quotients and of their squares.
  Sums (*divide)(const double* weights, double divisor, long count, double* quotients);

  template <int kLanes>
  static WeightsKernel compiled();
};

}  // namespace rex::internal
