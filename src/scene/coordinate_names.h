#pragma once

#include <string>
#include <vector>

#include "scene/model.h"

namespace rex {

/// What each number of q (nq) or v (nv) belongs to: "elbow", or of a joint with several "base [1]".
[[nodiscard]] std::vector<std::string> positionNames(const Model& model);
[[nodiscard]] std::vector<std::string> velocityNames(const Model& model);

}  // namespace rex
