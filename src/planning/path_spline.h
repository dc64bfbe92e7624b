#pragma once

#include <string>

#include "planning/path_curve.h"
#include "planning/path_problem.h"

namespace rex {

/// A uniform cubic B-spline: its first and second derivatives are continuous. It stays in the convex hull of
/// any four control points in turn, and is no longer than the straight lines between them.
class PathSpline {
 public:
  PathSpline() = default;
  /// Control points, one per column, the ends three times. Throws Error without points.
  explicit PathSpline(Eigen::MatrixXd control);

  const Eigen::MatrixXd& control() const { return control_; }
  /// The range of the parameter: one for each four control points in turn.
  [[nodiscard]] double length() const;
  /// At the parameter s, and at an end before 0 and after length(); its first or second derivative by s.
  /// Angles are not wrapped. Throws Error for an s that is not finite, and for a spline without control
  /// points.
  [[nodiscard]] Eigen::VectorXd value(double s, int derivative = 0) const;
  /// The same points as a curve whose derivative is nowhere zero because a control point stands three times:
  /// the straight ways there, a sixth of a side, have a third of the parameter, and it stops between two of
  /// them. Throws Error without control points.
  [[nodiscard]] PathCurve curve() const;

 private:
  Eigen::MatrixXd control_{};
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

/// A spline that has a path for control polygon: it cuts corners. How fast it can be followed is what
/// parametrizeTime() finds. Where it is not valid at the resolution of the problem, the polygon gets more
/// points, so that the spline comes nearer to the path, and in the end follows it and stops at its corners.
/// Never longer than the path; pieces that lie on it are not looked at in other points than those of an edge
/// check. Throws Error for a path of another size or without points, and a space with quaternions.
[[nodiscard]] SplineResult splineAlong(const PathProblem& problem, const MatrixArg& path);

}  // namespace rex
