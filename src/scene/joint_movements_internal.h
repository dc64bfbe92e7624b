#pragma once

#include <vector>

#include "scene/model.h"

namespace rex::internal {

/// One of the movements that a joint type does one after the other, with its coordinate. `axis` says how far
/// a slider goes per unit. Frame F of the joint comes before the first, M after the last.
struct JointMovement {
  MotionStep::Kind kind;
  int coordinate = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
};

[[nodiscard]] std::vector<JointMovement> movements(const Joint& joint);

}  // namespace rex::internal
