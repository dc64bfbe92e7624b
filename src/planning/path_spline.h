#pragma once

#include "planning/path_problem.h"

namespace rex {

/// A motion along a uniform cubic B-spline: position, velocity and acceleration are continuous, and it rests
/// at both ends. It stays in the convex hull of any four control points in turn, and is no longer than the
/// straight lines between them.
class PathSpline {
 public:
  PathSpline() = default;
  /// Control points, one per column, the ends three times; seconds from one to the next. Throws Error without
  /// points, and for a time that is negative or not finite.
  PathSpline(Eigen::MatrixXd control, double interval);

  const Eigen::MatrixXd& control() const { return control_; }
  [[nodiscard]] double duration() const;
  /// At t seconds, and at an end before 0 and after duration(). Angles are not wrapped. These three throw
  /// Error for a time that is not finite, and for a spline without control points.
  [[nodiscard]] Eigen::VectorXd position(double t) const { return value(t, 0); }
  [[nodiscard]] Eigen::VectorXd velocity(double t) const { return value(t, 1); }
  [[nodiscard]] Eigen::VectorXd acceleration(double t) const { return value(t, 2); }

 private:
  [[nodiscard]] Eigen::VectorXd value(double t, int derivative) const;

  Eigen::MatrixXd control_{};
  double interval_ = 0;
};

/// The largest velocity and acceleration of each number of a configuration, per second and second squared,
/// positive and finite; accelerations may be empty: any.
struct MotionLimits {
  Eigen::VectorXd velocity{}, acceleration{};
};

enum class SplineStatus {
  kSmooth,
  kStops,   ///< in places it goes straight, and stops at corners of the path
  kInvalid  ///< the path itself is not valid at the resolution
};

struct SplineResult {
  SplineStatus status = SplineStatus::kInvalid;
  PathSpline spline{};  ///< empty if kInvalid
  int stops = 0;        ///< between start and goal
  std::string message{};
};

/// A motion on a spline that has a path for control polygon: it cuts corners. It goes from one control point
/// to the next in equal times, the shortest within the limits: one of them is reached in some place.
/// Where that is not valid at the resolution of the problem, the polygon gets more points, so that the spline
/// comes nearer to the path, and in the end follows it and stops at its corners. Never longer than the path;
/// pieces that lie on it are not looked at in other points than those of an edge check. Throws Error for a
/// path of another size or without points, a space with quaternions, and limits that are not positive or not
/// finite, or of another size.
[[nodiscard]] SplineResult splineAlong(const PathProblem& problem, const MatrixArg& path,
                                       const MotionLimits& limits);

}  // namespace rex
