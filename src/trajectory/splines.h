#pragma once

#include <optional>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// A B-spline of any degree p >= 0 with evenly spaced knots and clamped ends: it starts at its first
/// control point, ends at its last, stays in the convex hulls of p + 1 consecutive ones, and has p - 1
/// continuous derivatives.
class BSpline {
 public:
  /// control: n x N, N > p. duration: seconds. Throws Error for fewer points, a degree below zero, a duration
  /// that is not positive, and numbers that are not finite.
  BSpline(const Eigen::MatrixXd& control, int degree, double duration);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] double duration() const { return duration_; }
  [[nodiscard]] const Eigen::MatrixXd& control() const { return control_; }
  /// The value (n) at t seconds, with t clamped to [0, duration()]. Throws Error for a time that is not
  /// finite.
  [[nodiscard]] Eigen::VectorXd value(double t) const;
  /// Its velocity: a B-spline of one degree less; zero for degree 0. Call it repeatedly for higher
  /// derivatives.
  [[nodiscard]] BSpline derivative() const;

 private:
  [[nodiscard]] double knot(Eigen::Index i) const;

  Eigen::MatrixXd control_;
  int degree_;
  double duration_;
};

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
