#pragma once

#include <vector>

#include "scene/model.h"

namespace rex::internal {

/// The steps that place all bodies of a scene, once its joints have their coordinates.
[[nodiscard]] std::vector<MotionStep> motionSteps(const Model& model);

/// The moving parts of a scene, once its joints have their coordinates.
[[nodiscard]] std::vector<Link> links(const Model& model);

}  // namespace rex::internal
