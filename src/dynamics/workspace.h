#pragma once

#include <vector>

#include "geometry/lie.h"
#include "kinematics/forward_kinematics.h"

namespace rex {

/// Memory for the functions of this module, owned by the caller of a hot loop: they allocate nothing once
/// it has been used with a model.
struct DynamicsWorkspace {
  /// As many numbers as a kernel processes at once, suitably aligned.
  struct alignas(64) Line {
    double numbers[8];
  };
  std::vector<Line> lines{};
  /// M and F, for models in which joints mimic others.
  Eigen::MatrixXd M{};
  Eigen::VectorXd F{};
  /// Used for a velocity or an acceleration of zero.
  Eigen::VectorXd zeros{};
  /// The poses of bodies, and a twist or a force of each.
  BodyPoses poses{};
  std::vector<Vector6d> perBody{};
};

}  // namespace rex
