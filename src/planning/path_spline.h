#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planning/path_problem.h"
#include "planning/space.h"

namespace rex {

class Rng;

/// A point on a path: q (nq), and its first and second derivatives with respect to the path parameter s (nv
/// each; for a quaternion the angular velocity in the moved frame, as in the model's velocities).
struct CurvePoint {
  Eigen::VectorXd q{}, dq{}, ddq{};
};

/// A twice differentiable piece of a path: `at` fills in the point at s, from 0 to `length` > 0.
struct CurvePiece {
  double length = 1;
  std::function<void(double s, CurvePoint& point)> at{};
  bool stopsAtEnd = false;  ///< the next piece may leave in another direction
};

/// A path as a curve q(s): from `start` through all pieces. Each piece begins where the previous one ends,
/// with the same derivative unless that one stops. Without pieces the path stays at the start.
struct PathCurve {
  Eigen::VectorXd start{};
  std::vector<CurvePiece> pieces{};

  /// The range of the parameter: the sum over all pieces.
  [[nodiscard]] double length() const;
  /// How many pieces stop, not counting the last.
  [[nodiscard]] int stops() const;
};

/// The straight segments of a path (one configuration per column), parametrised by length in velocity
/// coordinates. It stops where two segments differ in direction by more than 1e-7; repeated postures are
/// left out. Throws Error for a path of the wrong size or without columns.
[[nodiscard]] PathCurve straightCurve(const Space& space, const MatrixArg& path);

/// Configurations along a curve, one per column, so dense that the straight segments between them deviate
/// from the curve by at most about `tolerance` in each coordinate (h^2 |q''| / 8). Ends of pieces are
/// included.
[[nodiscard]] Eigen::MatrixXd sampled(const PathCurve& curve, double tolerance);

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

/// A shorter curve from start to goal of a path: splineAlong() after shortcut() of so many rounds. In spaces
/// with quaternions, and where the path is not valid at the points of a spline, it has straight segments and
/// stops at corners. Throws as these.
[[nodiscard]] PathCurve smoothCurve(const PathProblem& problem, const MatrixArg& path, int rounds, Rng& rng);

}  // namespace rex
