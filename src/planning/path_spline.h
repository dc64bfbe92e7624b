#pragma once

#include <string>

#include "planning/path_curve.h"
#include "planning/path_problem.h"

namespace rex {

/// A uniform cubic B-spline: its first and second derivatives are continuous. It stays in the convex hulls
/// of four consecutive control points, and is no longer than the polygon of the control points.
class PathSpline {
 public:
  PathSpline() = default;
  /// Control points, one per column, with both ends repeated three times. Throws Error without points.
  explicit PathSpline(Eigen::MatrixXd control);

  const Eigen::MatrixXd& control() const { return control_; }
  /// The range of the parameter: one per four consecutive control points.
  [[nodiscard]] double length() const;
  /// The value or the first or second derivative at the parameter s, which is clamped to [0, length()].
  /// Angles are not wrapped. Throws Error for an s that is not finite, and for a spline without control
  /// points.
  [[nodiscard]] Eigen::VectorXd value(double s, int derivative = 0) const;
  /// The same points as a curve whose derivative does not vanish at triple control points. The straight
  /// segments there, a sixth of a side, get a third of the parameter, and the curve stops between two of
  /// them. Throws Error without control points.
  [[nodiscard]] PathCurve curve() const;

 private:
  Eigen::MatrixXd control_{};
};

enum class SplineStatus {
  kSmooth,
  kStops,   ///< partly straight, with stops at corners of the path
  kInvalid  ///< the path itself is not valid at the resolution
};

struct SplineResult {
  SplineStatus status = SplineStatus::kInvalid;
  PathSpline spline{};  ///< empty if kInvalid
  int stops = 0;        ///< between start and goal
  std::string message{};
};

/// A spline with the path as its control polygon, so that it cuts corners; parametrizeTime() times it.
/// Where it is not valid at the problem's resolution, the polygon gets more points: the spline then comes
/// closer to the path, and finally follows it and stops at its corners. It is never longer than the path;
/// pieces that lie on the path are checked like edges. Throws Error for a path of the wrong size or without
/// points, and for a space with quaternions.
[[nodiscard]] SplineResult splineAlong(const PathProblem& problem, const MatrixArg& path);

}  // namespace rex
