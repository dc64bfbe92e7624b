#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "render/color.h"
#include "render/image.h"

namespace rex::internal {

/// How axes, point clouds, arrows and ellipsoids look, in pictures as in replays.
inline constexpr std::array<Color, 3> kAxisColors = {Color{0.84f, 0.15f, 0.16f}, Color{0.13f, 0.58f, 0.20f},
                                                     Color{0.12f, 0.35f, 0.80f}};
inline constexpr double kAxisWidth = 2.5;         // pixels
inline constexpr double kCloudPointRadius = 1.5;  // pixels

/// Shaft and head of an arrow, metres. A short one is thinner, so that it keeps its proportions.
struct ArrowForm {
  ArrowForm(double length, double wantedRadius)
      : radius(std::min(wantedRadius, length / 12)),
        headRadius(3 * radius),
        head(8 * radius),
        shaft(length - head) {}
  double radius, headRadius, head, shaft;
};

/// The radii with which an ellipsoid is drawn. A flat one, such as the spread of points in a plane, is a thin
/// lens; a point is nothing.
inline Eigen::Vector3d drawnRadii(const Eigen::Vector3d& radii) {
  constexpr double kThinnest = 1e-3;
  return radii.cwiseMax(kThinnest * radii.maxCoeff());
}

}  // namespace rex::internal
