#pragma once

#include <vector>

#include "geometry/lie.h"
#include "kinematics/forward_kinematics.h"

namespace rex {

/// Memory that functions of this module work in, kept by the caller of a hot loop: they allocate nothing once
/// it has been used with a model.
struct DynamicsWorkspace {
  /// As many numbers as a kernel takes at once, at addresses that suit it.
  struct alignas(64) Line {
    double numbers[8];
  };
  std::vector<Line> lines{};
  /// M and F of models in which joints mimic others.
  Eigen::MatrixXd M{};
  Eigen::VectorXd F{};
  /// What stands for no velocity or no acceleration.
  Eigen::VectorXd zeros{};
  /// Where bodies are, and a twist or a force of each.
  BodyPoses poses{};
  std::vector<Vector6d> perBody{};
};

}  // namespace rex
