#pragma once

#include <vector>

#include "course/car_view.h"
#include "render/film.h"

namespace rex {

/// The usual direction from cars to the camera: steeply from above.
inline const Eigen::Vector3d kFromAbove{10, -50, 99.5};

/// The view in three dimensions, on a ground with squares of 5 m. Throws Error as requireDrawable() does.
[[nodiscard]] Picture carPicture(const CarView& view);

/// The views, `step` seconds apart, on a ground around all that they show, which writeFilm() frames. Large
/// ellipses may extend beyond it. Throws Error as requireDrawable() does.
[[nodiscard]] Film carFilm(const std::vector<CarView>& views, double step = 1);

}  // namespace rex
