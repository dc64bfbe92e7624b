#pragma once

#include <functional>
#include <vector>

#include "planning/space.h"

namespace rex {

/// A place on a path: q (nq), and the first and second derivative by the parameter s of the path (nv each; of
/// a quaternion the turn of the moved frame, as velocities of the model have it).
struct CurvePoint {
  Eigen::VectorXd q{}, dq{}, ddq{};
};

/// A piece of a path that is twice differentiable: `at` fills the point at s, from 0 to `length` > 0.
struct CurvePiece {
  double length = 1;
  std::function<void(double s, CurvePoint& point)> at{};
  bool stopsAtEnd = false;  ///< the next piece may leave in another direction
};

/// A path as a curve q(s): from `start` through all pieces, each of which begins where the one before ends,
/// and with its derivative unless that stops. Without pieces it stays at the start.
struct PathCurve {
  Eigen::VectorXd start{};
  std::vector<CurvePiece> pieces{};

  /// Of the parameter: the sum over all pieces.
  [[nodiscard]] double length() const;
  /// How many pieces stop, but the last.
  [[nodiscard]] int stops() const;
};

/// The straight ways of a path, a configuration per column, with the length of velocities as parameter. It
/// stops where two of them differ in their direction by more than 1e-7; postures that repeat are left out.
/// Throws Error for a path of another size or without columns.
[[nodiscard]] PathCurve straightCurve(const Space& space, const MatrixArg& path);

/// Configurations along a curve, one per column, so dense that in each number the straight way between two of
/// them is no farther than about `tolerance` from the curve (h^2 |q''| / 8). Ends of pieces are among them.
[[nodiscard]] Eigen::MatrixXd sampled(const PathCurve& curve, double tolerance);

}  // namespace rex
