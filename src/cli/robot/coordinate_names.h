#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// positionNames() and velocityNames() of scene/coordinate_names.h, as they can be printed.
[[nodiscard]] std::vector<std::string> printablePositionNames(const Model& model);
[[nodiscard]] std::vector<std::string> printableVelocityNames(const Model& model);

/// The length of the longest name, and no less than `least`: the width of a column of them.
[[nodiscard]] std::size_t widestOf(const std::vector<std::string>& names, std::size_t least);

}  // namespace rex::cli
