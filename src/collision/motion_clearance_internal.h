#pragma once

#include "scene/model.h"

namespace rex::internal {

/// How fast a joint moves while q moves straight, per whole motion: bounds for all of it.
struct JointTravel {
  double angle = 0;  ///< radians that the moved frame M turns
  double way = 0;    ///< metres that its origin goes
};

/// Throws Error for a quaternion that is zero on the way.
[[nodiscard]] JointTravel jointTravel(const Joint& joint, const VectorArg& from, const VectorArg& to);

/// The last body that carries both, perhaps one of them.
[[nodiscard]] BodyId carrierOfBoth(const Model& model, BodyId a, BodyId b);

}  // namespace rex::internal
