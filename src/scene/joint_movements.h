#pragma once

#include <vector>

#include "scene/model.h"

namespace rex {

/// One of the movements that a joint type does one after the other.
struct JointMovement {
  MotionStep::Kind kind;
  int coordinate = 0;                              ///< its first one, of the joint's, in q as in v
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  ///< how far a slider goes per unit; unit for hinges
};

/// The movements of a joint: frame F comes before the first, M after the last. A rigid joint has one that is
/// fixed, a screw two of the same coordinate.
[[nodiscard]] std::vector<JointMovement> movements(const Joint& joint);

}  // namespace rex
