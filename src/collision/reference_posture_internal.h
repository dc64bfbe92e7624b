#pragma once

#include "scene/coordinates.h"
#include "scene/model.h"

namespace rex::internal {

/// All coordinates 0, all quaternions the identity.
[[nodiscard]] inline Eigen::VectorXd referencePosture(const Model& model) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
  forEachQuaternion(model, [&](int iq, int) { q[iq] = 1; });
  return q;
}

}  // namespace rex::internal
