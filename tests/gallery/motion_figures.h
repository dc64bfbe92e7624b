#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/figure.h"

namespace rex {

/// Curves of motions: splines, and how walkers balance. Under the names of their files; the same every time.
[[nodiscard]] std::vector<std::pair<std::string, Figure>> motionFigures();

}  // namespace rex
