#pragma once

#include <vector>

#include "kinematics/forward_kinematics.h"
#include "render/picture.h"

namespace rex {

/// The visible shapes of a scene, or all where none is visible, where `poses` puts them, each in its own
/// colour. Shapes whose mesh was not loaded are left out.
[[nodiscard]] std::vector<Solid> solidsOf(const Model& model, const BodyPoses& poses);

/// The same on a ground that is never above a shape. Looks at every vertex of every mesh for that.
[[nodiscard]] Picture pictureOf(const Model& model, const BodyPoses& poses);

}  // namespace rex
