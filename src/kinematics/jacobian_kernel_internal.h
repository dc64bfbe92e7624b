#pragma once

namespace rex::internal {

/// The sums that Jacobians are made of, in plain numbers, for n configurations at once: number e of vector or
/// pose x in configuration k stands at x[e n + k].
struct JacobianKernel {
  struct Functions {
    /// p_WQ = X_WB * p_BQ.
    void (*point)(const double* X_WB, const double* p_BQ, double* p_WQ);
    /// Adds to `column` the velocity of Q where a twist given in frame X_WF moves by 1.
    void (*addVelocity)(const double* X_WF, const double* angular, const double* linear, const double* p_WQ,
                        double* column);
    /// Adds to `column` that velocity and, behind it, the angular velocity: six numbers.
    void (*addTwist)(const double* X_WF, const double* angular, const double* linear, const double* p_WQ,
                     double* column);
    /// Adds to `column` its angular velocity.
    void (*addAngular)(const double* X_WF, const double* angular, double* column);
  };
  Functions one;    ///< n = 1
  Functions block;  ///< n = kBlock
  static constexpr int kBlock = 8;

  template <int kLanes>
  static JacobianKernel compiled();
};

}  // namespace rex::internal
