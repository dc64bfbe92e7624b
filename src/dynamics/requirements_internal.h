#pragma once

#include "scene/model.h"

namespace rex::internal {

/// Throws Error naming both sizes unless q has nq numbers and v nv, and for quaternions in q that are zero or
/// not finite.
void requirePositions(const Model& model, const VectorArg& q);
void requireVelocities(const Model& model, const VectorArg& v);

/// Whether joints share coordinates.
[[nodiscard]] bool hasMimics(const Model& model);

/// Throws Error: the joint of the link moves no mass. Says which body needs some.
[[noreturn]] void throwSingular(const Model& model, const Link& link);

}  // namespace rex::internal
