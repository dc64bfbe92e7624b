#pragma once

#include "course/car_view.h"

namespace rex {

struct Figure;

/// The view from above as a figure with equal axes in metres: the map with its ellipses, paths, particles
/// and landmarks. You may change the title, the legend and everything else afterwards; plot() draws it.
/// Throws Error as requireDrawable() does.
[[nodiscard]] Figure figureOf(const CarView& view);

}  // namespace rex
