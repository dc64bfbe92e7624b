#pragma once

#include <optional>
#include <vector>

#include "kinematics/forward_kinematics.h"
#include "render/picture.h"

namespace rex {

/// The visible shapes of a scene, or all if none is visible, at `poses`, each in its own colour. Shapes
/// whose mesh was not loaded are left out.
[[nodiscard]] std::vector<Solid> solidsOf(const Model& model, const BodyPoses& poses);

/// Where the ground of a scene is, if it has one: the highest point of its shapes that are called so (W,
/// metres).
[[nodiscard]] std::optional<double> groundHeight(const Model& model, const BodyPoses& poses);

/// The same on the ground of the scene, or else on one that is never above a shape, for which it checks every
/// vertex of every mesh.
[[nodiscard]] Picture pictureOf(const Model& model, const BodyPoses& poses);

}  // namespace rex
