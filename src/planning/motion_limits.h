#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/vector_arg.h"
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

}  // namespace rex
