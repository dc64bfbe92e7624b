#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/vector_arg.h"
#include "scene/model.h"

namespace rex {

/// What a motion must keep to, for each coordinate of velocities (nv), in both directions.
struct MotionLimits {
  Eigen::VectorXd velocity{};      ///< positive, finite
  Eigen::VectorXd acceleration{};  ///< positive; infinite or empty: any
  Eigen::VectorXd effort{};        ///< force or torque of the joint, positive; infinite or empty: any
  /// Fills u with the efforts that a motion takes, as inverseDynamics(). They must be linear in a and in the
  /// products of velocities: no damping or friction. Needed where efforts are limited.
  std::function<void(const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     Eigen::Ref<Eigen::VectorXd> u)>
      forces{};
  std::vector<std::string> names{};  ///< of coordinates, for messages; empty: their numbers
};

/// What is taken where a scene says nothing.
struct LimitDefaults {
  double velocity = 1;  ///< rad/s or m/s, of joints whose limit is missing or 0
  double ramp = 0.5;    ///< seconds in which each joint reaches its limit of velocity from rest
  bool effort = false;  ///< keep to the efforts of the scene, against gravity, without friction of joints
};

/// The limits of a model's joints.
struct JointLimits {
  MotionLimits limits{};
  std::vector<std::string> assumedVelocity{};  ///< coordinates with the default velocity
  std::vector<std::string> anyEffort{};        ///< if efforts are kept to: coordinates without such a limit
};

/// Velocities and efforts are those of the scene (of a URDF its <limit>), of joints that mimic others too,
/// which share their coordinate; accelerations are velocity / ramp, because no scene has them. A limit of 0,
/// which files write for one that is not known, counts as none. Throws Error for defaults that are not
/// positive.
[[nodiscard]] JointLimits jointLimits(const Model& model, const LimitDefaults& defaults = {});

}  // namespace rex
