#pragma once

#include <string>

#include "course/course.h"
#include "map_pictures.h"

// How reprojection errors are drawn.

inline rex::Series pixelsOf(const std::string& label, const Eigen::Matrix2Xd& pixels, rex::Marker marker,
                            const rex::Color& color) {
  rex::Series series{
      .label = label, .style = rex::SeriesStyle::kPoints, .marker = marker, .size = 1.3, .color = color};
  for (const auto pixel : pixels.colwise()) series.add(pixel.x(), pixel.y());
  return series;
}

/// Given pixels as circles, where P maps the points as crosses, and from one to the other an arrow that is
/// `enlarged` times as long.
inline rex::Figure reprojection(const std::string& title, const Eigen::Matrix2Xd& pixels,
                                const Eigen::Matrix2Xd& errors, double enlarged) {
  const std::string times = std::to_string(static_cast<int>(enlarged));
  rex::Arrows arrows{.label = enlarged == 1 ? "errors" : "errors, " + times + " times as long",
                     .color = kRed};
  for (Eigen::Index i = 0; i < pixels.cols(); ++i) {
    arrows.x.push_back(pixels(0, i));
    arrows.y.push_back(pixels(1, i));
    arrows.dx.push_back(enlarged * errors(0, i));
    arrows.dy.push_back(enlarged * errors(1, i));
  }
  return {.title = title,
          .xLabel = "u [pixels]",
          .yLabel = "v [pixels]",
          .equalAxes = true,
          .legend = rex::Legend::kOutside,
          .series = {pixelsOf("given", pixels, rex::Marker::kCircle, kBlack),
                     pixelsOf("by P", pixels + errors, rex::Marker::kCross, kBlue)},
          .arrows = {arrows},
          .width = 900,
          .height = 640};
}
