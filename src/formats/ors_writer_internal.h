#pragma once

#include <string>

#include <Eigen/Core>

#include "geometry/pose.h"
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

/// Throws Error "written as ENDING, it could not be read back: ..." if rex does not read what it wrote:
/// ".ors" or ".urdf" text that breaks a limit of its reader.
void requireReadable(const std::string& text, const std::string& ending);

}  // namespace rex

// How values are written in .ors: as short as they can be read back.
namespace rex::ors {

/// The shortest decimal that is read as the same double.
[[nodiscard]] std::string numberText(double value);

/// "[1 2 3]".
[[nodiscard]] std::string arrayText(const Eigen::Ref<const Eigen::VectorXd>& values);

/// "<T t(0 0 1) d(90 1 0 0)>", exact to some 1e-15. A turn about a coordinate axis is written in degrees, as
/// people do, any other as a quaternion, which is exact near every rotation.
[[nodiscard]] std::string poseText(const Pose& X);

}  // namespace rex::ors
