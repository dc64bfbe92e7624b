#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// What each number of q or v belongs to: "elbow", or of a joint with several "elbow [1]".
[[nodiscard]] std::vector<std::string> positionNames(const Model& model);
[[nodiscard]] std::vector<std::string> velocityNames(const Model& model);

/// The length of the longest name, and no less than `least`: the width of a column of them.
[[nodiscard]] std::size_t widestOf(const std::vector<std::string>& names, std::size_t least);

}  // namespace rex::cli
