#pragma once

#include "geometry/rotation.h"
#include "render/renderer.h"

namespace rex {

/// A small picture with all that a renderer does: shapes, shadow, translucency, lines, points and text.
inline Picture variedPicture() {
  const Color wood{0.75f, 0.63f, 0.48f}, orange{0.85f, 0.45f, 0.2f}, glass{0.22f, 0.45f, 0.70f, 0.4f};
  Picture picture;
  picture.solids = {
      {{ShapeType::kBox, {0.5, 0.4, 0.6}, 0},
       translation(0.5, 0, 0.3) * rotation(0.3, {0, 0, 1}),
       wood,
       "box"},
      {{.type = ShapeType::kSphere, .radius = 0.2}, translation(0.5, 0, 0.8), orange, "sphere"},
      {{ShapeType::kCylinder, {0, 0, 0.7}, 0.15}, translation(-0.1, 0.2, 0.35), orange, "cylinder"},
      {{ShapeType::kCapsule, {0, 0, 0.5}, 0.1},
       translation(-0.5, 0.3, 0.3) * rotation(1, {0, 1, 0.3}),
       wood,
       "capsule"},
      {{ShapeType::kBox, {0.9, 0.1, 0.5}, 0}, translation(0, -0.5, 0.25), glass, "pane"}};
  picture.polylines = {{{{-0.7, -0.6, 0}, {0.7, -0.2, 0.5}, {0.3, 0.4, 1.1}}, orange}};
  picture.pointSets = {{.points = {{-0.5, -0.5, 0}, {0, 0.1, 0.7}, {0.5, -0.5, 0}}}};
  picture.axes = {{translation(-0.6, -0.2, 0.6), 0.3, "A"}};
  picture.labels = {{"sphere", {0.5, 0, 0.8}}};
  picture.captions = {{"varied"}};
  return picture;
}

inline Image drawVaried(Renderer& renderer) {
  const Picture picture = variedPicture();
  const double aspect = static_cast<double>(renderer.options().width) / renderer.options().height;
  return renderer.draw(picture, framing(bounds(picture), kDefaultView, aspect));
}

}  // namespace rex
