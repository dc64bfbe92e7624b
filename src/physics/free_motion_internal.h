#pragma once

#include "physics/mover_internal.h"

namespace rex::internal {

/// How the coordinates of a free joint of the world describe the motion of its link, whose frame L is where
/// bulletLink() puts it.
class FreeMotion {
 public:
  /// X_WP is the pose of the joint's parent, which stands still.
  FreeMotion(const Joint& joint, const Pose& X_WP, const Pose& X_BL);

  /// Pose of the link, and velocity of its origin, in W.
  struct LinkMotion {
    Pose X_WL{};
    Eigen::Vector3d linear_W, angular_W;
  };
  [[nodiscard]] LinkMotion linkMotion(const State& state) const;
  void read(const LinkMotion& motion, State& state) const;

  /// Whether wrench() is zero, whatever the motion.
  [[nodiscard]] bool isIdle(std::span<const Motor> motors) const;
  /// Force and torque at the link's origin, in W: what the motors (forces all) demand.
  struct Wrench {
    Eigen::Vector3d force_W, torque_W;
  };
  /// From the link's origin to that of the joint's moved frame, in W.
  [[nodiscard]] Eigen::Vector3d p_LM_W(const LinkMotion& motion) const { return motion.X_WL.R * X_LM_.p; }
  [[nodiscard]] Wrench wrench(std::span<const Motor> motors, const LinkMotion& motion) const;

 private:
  int qIndex_, vIndex_;
  Pose X_WF_, X_ML_, X_LM_;
};

}  // namespace rex::internal
