#pragma once

#include "scene/model.h"

namespace rex::internal {

/// Throws Error naming both sizes unless q has nq numbers and v nv, and for quaternions in q that are zero or
/// not finite.
void requirePositions(const Model& model, const VectorArg& q);
void requireVelocities(const Model& model, const VectorArg& v);

/// Whether links share coordinates.
[[nodiscard]] bool hasMimics(const Model& model);

/// The joint that the link at this place of Model::links() belongs to.
[[nodiscard]] const Joint& jointOfLink(const Model& model, int link);

/// Throws Error: the joint moves no mass. Says which body needs some.
[[noreturn]] void throwSingular(const Model& model, const Joint& joint);

}  // namespace rex::internal
