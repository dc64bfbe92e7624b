#pragma once

#include <string>

#include <Eigen/Core>

#include "geometry/pose.h"

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
