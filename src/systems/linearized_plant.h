#pragma once

#include <Eigen/Core>

namespace rex {

/// The derivatives of x' = f(x, u) at one point, for a plant with four states and one control: near x0 and
/// u0, x' = f(x0, u0) + A (x - x0) + B (u - u0).
struct LinearizedPlant {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d B{0, 0, 0, 0};
};

}  // namespace rex
