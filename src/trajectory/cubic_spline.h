#pragma once

#include <optional>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// Velocities at the ends of a spline (n); if empty, the acceleration is zero there (a natural end).
struct SplineEnds {
  std::optional<Eigen::VectorXd> startVelocity{}, endVelocity{};
};

/// The interpolating cubic spline through given points at given times, with continuous velocity and
/// acceleration. Among all curves through these points with these ends it has the least integral of squared
/// acceleration.
class CubicSpline {
 public:
  /// times: N >= 2, rising, seconds. points: n x N. Throws Error for wrong sizes, times that do not rise,
  /// and numbers that are not finite.
  CubicSpline(const VectorArg& times, const MatrixArg& points, const SplineEnds& ends = {});

  [[nodiscard]] double start() const { return times_[0]; }
  [[nodiscard]] double end() const { return times_[times_.size() - 1]; }
  /// The derivative (n) of order 0 to 3 at t seconds. Before the start and after the end the nearest piece
  /// is extrapolated. Throws Error for a time that is not finite and for other orders.
  [[nodiscard]] Eigen::VectorXd value(double t, int derivative = 0) const;

 private:
  Eigen::VectorXd times_;
  Eigen::MatrixXd points_, velocities_;  // n x N
};

}  // namespace rex
