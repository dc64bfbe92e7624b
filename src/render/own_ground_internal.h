#pragma once

#include <optional>

#include "render/picture.h"

namespace rex::internal {

/// At which height the checkered ground of a picture is drawn, W, metres: at its own, or lower by a
/// thousandth of the radius of `scene` where something flat lies in it, which would flicker. None for a
/// picture without ground, or with one of its own: something flat at about that height, or a floor in a mesh,
/// that takes at least half of the scene seen from above.
[[nodiscard]] std::optional<double> checkerHeight(const Picture& picture, const Bounds& scene);

}  // namespace rex::internal
