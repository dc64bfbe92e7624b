#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/figure.h"

namespace rex {

/// One figure of each kind with data of the course, under the name of its file; the same every time.
[[nodiscard]] std::vector<std::pair<std::string, Figure>> galleryFigures();

}  // namespace rex
