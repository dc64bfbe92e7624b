#pragma once

#include <cstddef>
#include <vector>

#include "planning/path_curve.h"

namespace rex {

/// The configuration q (nq) of a motion, its velocity and acceleration (nv each).
struct MotionPoint {
  Eigen::VectorXd q{}, v{}, a{};
};

/// A path with a time for each of its points. Between grid points the second time derivative of the
/// parameter is constant.
class TimedPath {
 public:
  /// A part of a piece, in which the parameter of the piece goes from `from` to `to`.
  struct Interval {
    std::size_t piece = 0;
    double from = 0, to = 0;
  };

  TimedPath() = default;
  /// `squares` are the squared speeds of the parameter at the grid points, one more than intervals; no two
  /// consecutive ones are zero.
  TimedPath(PathCurve curve, std::vector<Interval> intervals, std::vector<double> squares);

  /// Seconds at the grid points, from 0; a single one if there are no intervals.
  const std::vector<double>& times() const { return times_; }
  /// The parameter of the whole path at the grid points, and its squared speed.
  const std::vector<double>& places() const { return places_; }
  const std::vector<double>& squares() const { return squares_; }
  const PathCurve& curve() const { return curve_; }
  [[nodiscard]] double duration() const { return times_.back(); }
  /// The motion at t seconds, with t clamped to [0, duration()]. Where the acceleration jumps, the later
  /// value is returned. Throws Error for a time that is not finite.
  [[nodiscard]] MotionPoint at(double t) const;

 private:
  PathCurve curve_{};
  std::vector<Interval> intervals_{};
  std::vector<double> squares_{}, places_{0}, times_{0};
};

}  // namespace rex
