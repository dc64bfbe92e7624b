#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/draw_list_internal.h"

namespace rex::internal {
namespace {

constexpr std::array<Color, 3> kAxisColors = {Color{0.84f, 0.15f, 0.16f}, Color{0.13f, 0.58f, 0.20f},
                                              Color{0.12f, 0.35f, 0.80f}};
constexpr double kAxisWidth = 2.5;  // pixels

std::optional<DrawItem> itemOf(const Solid& solid) {
  const Shape& shape = solid.shape;
  const double r = shape.radius;
  DrawItem item{.X_WS = solid.X_WS, .color = solid.color};
  switch (shape.type) {
    case ShapeType::kBox:
    case ShapeType::kRoundedBox:
      item.halfSize = shape.extent / 2;
      break;
    case ShapeType::kSphere:
    case ShapeType::kCapsule:
      item.mesh = MeshKind::kCapsule;
      item.halfSize.setConstant(r);
      item.stretch = shape.type == ShapeType::kCapsule ? shape.extent.z() / 2 : 0;
      break;
    case ShapeType::kCylinder:
      item.mesh = MeshKind::kCylinder;
      item.halfSize = {r, r, shape.extent.z() / 2};
      break;
    default:
      return std::nullopt;
  }
  if (item.halfSize.minCoeff() <= 0 || item.color.a <= 0) return std::nullopt;
  return item;
}

// Where it is nearest to the camera.
double radiusInPixels(const DrawItem& item, const Camera& camera, int pictureHeight) {
  const double depth = std::max((item.X_WS.p - camera.X_WC.p).norm() - item.stretch, camera.nearPlane);
  const double focal = pictureHeight / (2 * std::tan(camera.verticalFov / 2));
  return focal * radiusOf(item) / depth;
}

}  // namespace

double radiusOf(const DrawItem& item) { return std::max(item.halfSize.x(), item.halfSize.y()); }

DrawList makeDrawList(const Picture& picture, const Camera& camera, int pictureHeight) {
  DrawList list;
  for (const Solid& solid : picture.solids) {
    std::optional<DrawItem> item = itemOf(solid);
    if (!item) continue;
    item->solid = static_cast<int>(&solid - picture.solids.data());
    item->detail = detailFor(radiusInPixels(*item, camera, pictureHeight));
    (item->color.a < 1 ? list.translucent : list.opaque).push_back(*item);
  }
  const auto distance = [&](const DrawItem& item) { return (item.X_WS.p - camera.X_WC.p).squaredNorm(); };
  std::stable_sort(list.translucent.begin(), list.translucent.end(),
                   [&](const DrawItem& a, const DrawItem& b) { return distance(a) > distance(b); });
  return list;
}

std::vector<Polyline> overlayLines(const Picture& picture) {
  std::vector<Polyline> lines = picture.polylines;
  const auto addAxes = [&](const Pose& X_WF, double from, double to) {
    for (int i = 0; i < 3; ++i)
      lines.push_back(
          {{X_WF.p + from * X_WF.R.col(i), X_WF.p + to * X_WF.R.col(i)}, kAxisColors[i], kAxisWidth});
  };
  for (const Axes& axes : picture.axes) addAxes(axes.X_WF, 0, axes.size);
  for (const Solid& solid : picture.solids) {
    const double half = solid.shape.extent.x() / 2;
    if (solid.shape.type == ShapeType::kMarker) addAxes(solid.X_WS, -half, half);
  }
  return lines;
}

}  // namespace rex::internal
