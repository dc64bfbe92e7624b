#include "render/film.h"

#include <algorithm>

namespace rex {

Bounds bounds(const Film& film) {
  Bounds all;
  for (const Frame& frame : film) {
    const Bounds one = bounds(frame.picture);
    if (one.isEmpty()) continue;
    all.include(one.low);
    all.include(one.high);
  }
  return all;
}

Camera framing(const Film& film, const Eigen::Vector3d& direction, double aspect) {
  return framing(bounds(film), direction, aspect);
}

void settleGround(Film& film) {
  const auto lower = [](const Frame& a, const Frame& b) {
    return a.picture.ground.height < b.picture.ground.height;
  };
  const auto lowest = std::min_element(film.begin(), film.end(), lower);
  if (lowest == film.end()) return;
  const double height = lowest->picture.ground.height;
  const Bounds scene = bounds(film);
  for (Frame& frame : film) {
    frame.picture.ground.height = height;
    frame.picture.ground.scene = scene;
  }
}

}  // namespace rex
