#pragma once

#include <algorithm>
#include <array>

#include "render/color.h"

namespace rex::internal {

/// How axes, point clouds and arrows look, in pictures as in replays.
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

}  // namespace rex::internal
