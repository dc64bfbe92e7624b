#pragma once

#include <string>

#include "scene/model.h"

namespace rex::bench {

/// The scene as a MuJoCo model file (MJCF): bodies with their joints and masses under our names, no shapes.
/// For hinges and sliders; a body with any other joint is welded to its parent.
[[nodiscard]] std::string mujocoXml(const Model& model);

}  // namespace rex::bench
