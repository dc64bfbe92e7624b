#pragma once

#include <vector>

#include "scene/model.h"

namespace rex {

/// World poses of all bodies, indexed by BodyId; the world itself comes first.
struct BodyPoses {
  std::vector<Pose> X_WB;
  const Pose& operator[](BodyId id) const { return X_WB[static_cast<std::size_t>(id)]; }
};

/// The poses of all bodies at posture q (nq). Throws Error naming both sizes if that of q is wrong, and for
/// quaternions that are zero or not finite. Slide 2:18.
[[nodiscard]] BodyPoses forwardKinematics(const Model& model, const VectorArg& q);
/// The same into storage of the caller; allocates nothing once `out` has been used with this model.
void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out);

}  // namespace rex
