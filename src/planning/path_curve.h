#pragma once

#include <functional>
#include <vector>

#include "planning/space.h"

namespace rex {

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

}  // namespace rex
