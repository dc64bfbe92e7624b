#pragma once

#include "course/car_view.h"

namespace rex {

struct Figure;

/// The view from above, with equal axes in metres: map with ellipses, ways, particles and landmarks. Title,
/// legend and all else may be changed afterwards; plot() draws it. Throws Error as requireDrawable().
[[nodiscard]] Figure figureOf(const CarView& view);

}  // namespace rex
