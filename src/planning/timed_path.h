#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"
#include "planning/path_spline.h"
#include "scene/model.h"

namespace rex {

/// The limits of a motion for each velocity coordinate (nv), in both directions.
struct MotionLimits {
  Eigen::VectorXd velocity{};      ///< positive, finite
  Eigen::VectorXd acceleration{};  ///< positive; infinite or empty: unlimited
  Eigen::VectorXd effort{};        ///< force or torque of the joint, positive; infinite or empty: unlimited
  /// Fills u with the efforts that a motion takes, like inverseDynamics(). They must be linear in a and in
  /// the products of velocities, without damping or friction. Required if efforts are limited.
  std::function<void(const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     Eigen::Ref<Eigen::VectorXd> u)>
      forces{};
  std::vector<std::string> names{};  ///< of the coordinates, for messages; empty: their numbers
};

/// Limits that are assumed if a scene does not specify them.
struct LimitDefaults {
  double velocity = 1;  ///< rad/s or m/s, of joints whose limit is missing or 0
  double ramp = 0.5;    ///< seconds in which each joint reaches its velocity limit from rest
  bool effort = false;  ///< respect the scene's effort limits, with gravity, without joint friction
};

/// The limits of a model's joints.
struct JointLimits {
  MotionLimits limits{};
  std::vector<std::string> assumedVelocity{};  ///< coordinates with the default velocity
  std::vector<std::string> anyEffort{};  ///< if efforts are limited: coordinates without an effort limit
};

/// Limits of velocities and efforts come from the scene (the <limit> of a URDF), also those of mimic
/// joints, which share a coordinate. Acceleration limits are velocity / ramp, because scenes do not have
/// them. A limit of 0, which files use for an unknown one, counts as missing. Throws Error for defaults
/// that are not positive.
[[nodiscard]] JointLimits jointLimits(const Model& model, const LimitDefaults& defaults = {});

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
