#pragma once

#include <Eigen/Core>

namespace rex {

/// A B-spline of any degree p >= 0 with evenly spaced knots and clamped ends: it starts at its first control
/// point, ends at its last, stays in the hull of any p + 1 in turn, and has p - 1 continuous derivatives.
class BSpline {
 public:
  /// control: n x N, N > p. duration: seconds. Throws Error for fewer points, a degree below zero, a duration
  /// that is not positive, and numbers that are not finite.
  BSpline(const Eigen::MatrixXd& control, int degree, double duration);

  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] double duration() const { return duration_; }
  [[nodiscard]] const Eigen::MatrixXd& control() const { return control_; }
  /// At t seconds, and at an end before 0 and after duration(). n. Throws Error for a time that is not
  /// finite.
  [[nodiscard]] Eigen::VectorXd value(double t) const;
  /// Its velocity: a B-spline of one degree less. Of degree 0 it is zero. Derivatives of it are those of
  /// higher order.
  [[nodiscard]] BSpline derivative() const;

 private:
  [[nodiscard]] double knot(Eigen::Index i) const;

  Eigen::MatrixXd control_;
  int degree_;
  double duration_;
};

}  // namespace rex
