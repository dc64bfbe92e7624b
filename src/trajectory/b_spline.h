#pragma once

#include <Eigen/Core>

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

}  // namespace rex
