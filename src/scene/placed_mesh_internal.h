#pragma once

#include "scene/scene_spec.h"

namespace rex {

/// How a file that is read the other way (ShapeSpec::ignoresUpAxis) has to be scaled, and the result turned
/// in the frame of the shape, to be the mesh of the shape.
struct PlacedMesh {
  Eigen::Matrix3d R_SM = Eigen::Matrix3d::Identity();
  Eigen::Vector3d scale{1, 1, 1};
};
[[nodiscard]] inline PlacedMesh placedMesh(const ShapeSpec& shape, bool ignoresUpAxis) {
  if (shape.ignoresUpAxis == ignoresUpAxis) return {.scale = shape.meshScale};
  const Eigen::Matrix3d R = shape.ignoresUpAxis ? shape.meshTurn.transpose() : shape.meshTurn;
  return {R, (R.transpose() * shape.meshScale.asDiagonal() * R).diagonal()};
}

}  // namespace rex
