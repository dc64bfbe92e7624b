#pragma once

#include <string>
#include <vector>

#include "scene/model.h"

namespace rex {

/// The name of each entry of q (nq) or v (nv): its joint's, "elbow", or "base [1]" if the joint has
/// several.
[[nodiscard]] std::vector<std::string> positionNames(const Model& model);
[[nodiscard]] std::vector<std::string> velocityNames(const Model& model);

}  // namespace rex
