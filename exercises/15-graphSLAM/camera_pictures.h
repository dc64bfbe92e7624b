#pragma once

#include <string>

#include "course/course.h"
#include "map_pictures.h"

// How reprojection errors are drawn.

/// Given pixels as circles, where P maps the points as crosses, and from one to the other an arrow that is
/// `enlarged` times as long.
inline rex::Figure reprojection(const std::string& title, const Eigen::Matrix2Xd& pixels,
                                const Eigen::Matrix2Xd& errors, double enlarged) {
  const std::string times = std::to_string(static_cast<int>(enlarged));
  rex::Arrows arrows{.label = enlarged == 1 ? "errors" : "errors, " + times + " times as long",
                     .color = kRed};
  for (Eigen::Index i = 0; i < pixels.cols(); ++i) arrows.add(pixels.col(i), enlarged * errors.col(i));
  return {
      .title = title,
      .xLabel = "u [pixels]",
      .yLabel = "v [pixels]",
      .equalAxes = true,
      .legend = rex::Legend::kOutside,
      .series = {rex::dots(pixels,
                           {.label = "given", .marker = rex::Marker::kCircle, .size = 1.3, .color = kBlack}),
                 rex::dots(pixels + errors,
                           {.label = "by P", .marker = rex::Marker::kCross, .size = 1.3, .color = kBlue})},
      .arrows = {arrows},
      .width = 900,
      .height = 640};
}
