#pragma once

#include <vector>

#include "scene/model.h"

namespace rex::internal {

/// The moving parts of a scene, once its joints have their coordinates.
[[nodiscard]] std::vector<Link> links(const Model& model);

}  // namespace rex::internal
