#pragma once

#include "scene/link.h"

namespace rex::internal {

/// Forward kinematics in plain numbers, for n configurations at once: number e of the pose of body b in
/// configuration k stands at X_WB[(12 b + e) n + k], and q[k] points to the coordinates of configuration k.
/// The poses of the bodies that come before all steps must stand there.
struct ForwardKinematicsKernel {
  using Place = void (*)(const MotionStep* steps, int stepCount, const double* const* q, double* X_WB);
  Place one;    ///< n = 1
  Place block;  ///< n = kBlock
  static constexpr int kBlock = 8;

  template <int kLanes>
  static ForwardKinematicsKernel compiled();
};

}  // namespace rex::internal
