#pragma once

#include <cstddef>
#include <vector>

#include "planning/path_curve.h"

namespace rex {

/// Where a motion is, and its velocity and acceleration (nv each).
struct MotionPoint {
  Eigen::VectorXd q{}, v{}, a{};
};

/// A path with a time for each of its points: between the points of a grid the second derivative of the
/// parameter by time is constant.
class TimedPath {
 public:
  /// A part of a piece, in which the parameter of the piece goes from `from` to `to`.
  struct Interval {
    std::size_t piece = 0;
    double from = 0, to = 0;
  };

  TimedPath() = default;
  /// `squares` are those of the parameter's speed at the grid, one more than intervals; no two in turn are
  /// zero.
  TimedPath(PathCurve curve, std::vector<Interval> intervals, std::vector<double> squares);

  /// Seconds at the grid, from 0; one where there are no intervals.
  const std::vector<double>& times() const { return times_; }
  /// The parameter of the whole path at the grid, and the square of its speed.
  const std::vector<double>& places() const { return places_; }
  const std::vector<double>& squares() const { return squares_; }
  const PathCurve& curve() const { return curve_; }
  [[nodiscard]] double duration() const { return times_.back(); }
  /// At t seconds, and at an end before 0 and after duration(); where the acceleration jumps, as it is next.
  /// Throws Error for a time that is not finite.
  [[nodiscard]] MotionPoint at(double t) const;

 private:
  PathCurve curve_{};
  std::vector<Interval> intervals_{};
  std::vector<double> squares_{}, places_{0}, times_{0};
};

}  // namespace rex
