#pragma once

#include "kinematics/forward_kinematics.h"
#include "render/picture.h"

namespace rex {

/// The visible shapes of a scene, or all where none is visible, where `poses` puts them, each in its own
/// colour, on a ground that is never above a shape. Shapes whose mesh was not loaded are left out.
[[nodiscard]] Picture pictureOf(const Model& model, const BodyPoses& poses);

}  // namespace rex
