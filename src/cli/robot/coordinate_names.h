#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex::cli {

/// positionNames() and velocityNames() of scene/coordinate_names.h, safe to print.
[[nodiscard]] std::vector<std::string> printablePositionNames(const Model& model);
[[nodiscard]] std::vector<std::string> printableVelocityNames(const Model& model);

/// The column width for names: the length of the longest, at least `least`.
[[nodiscard]] std::size_t widestOf(const std::vector<std::string>& names, std::size_t least);

}  // namespace rex::cli
