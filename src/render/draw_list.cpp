#include <algorithm>
#include <cmath>

#include "geometry/rotation.h"
#include "render/draw_list_internal.h"
#include "render/picture_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

// The radius where the item is nearest to the camera, judged by its bounding box.
double radiusInPixels(const DrawItem& item, const Camera& camera, int pictureHeight) {
  const Vector3d p_SC = item.X_WS.R.transpose() * (camera.X_WC.p - item.X_WS.p);
  const double distance = (p_SC.cwiseAbs() - halfExtent(item)).cwiseMax(0).norm();
  const double depth = std::max(distance, camera.nearPlane);
  const double focal = pictureHeight / (2 * std::tan(camera.verticalFov / 2));
  return focal * radiusOf(item) / depth;
}

class Builder {
 public:
  Builder(const Camera& camera, int pictureHeight) : camera_(camera), pictureHeight_(pictureHeight) {}

  void addSolid(const Solid& solid, int index) {
    solid_ = index;
    const Shape& shape = solid.shape;
    const double r = shape.radius;
    switch (shape.type) {
      case ShapeType::kBox:
        return add({.mesh = MeshKind::kBox, .halfSize = shape.extent / 2}, solid);
      case ShapeType::kRoundedBox:
        return addRoundedBox(solid);
      case ShapeType::kSphere:
        return add({.mesh = MeshKind::kCapsule, .halfSize = {r, r, r}}, solid);
      case ShapeType::kEllipsoid:
        return add({.mesh = MeshKind::kCapsule, .halfSize = shape.extent / 2}, solid);
      case ShapeType::kCapsule:
        return add(
            {.mesh = MeshKind::kCapsule, .halfSize = {r, r, r}, .stretch = {0, 0, shape.extent.z() / 2}},
            solid);
      case ShapeType::kCylinder:
        return add({.mesh = MeshKind::kCylinder, .halfSize = {r, r, shape.extent.z() / 2}}, solid);
      case ShapeType::kCone:
        return add({.mesh = MeshKind::kCone, .halfSize = {r, r, shape.extent.z() / 2}}, solid);
      case ShapeType::kMesh:
      case ShapeType::kSphereSweptConvex:
        return addMesh(solid);
      case ShapeType::kMarker:
      case ShapeType::kPointCloud:
        return;
    }
  }

  void addArrow(const Arrow& arrow) {
    const Vector3d along = arrow.to - arrow.from;
    const double length = along.norm();
    if (!(length > 0)) return;
    const ArrowForm form(length, arrow.radius);
    const Eigen::Matrix3d R = rotationBetween(Vector3d::UnitZ(), along);
    const auto at = [&](double way) -> Pose { return {R, arrow.from + way / length * along}; };
    add({.mesh = MeshKind::kCylinder,
         .X_WS = at(form.shaft / 2),
         .halfSize = {form.radius, form.radius, form.shaft / 2},
         .color = arrow.color});
    add({.mesh = MeshKind::kCone,
         .X_WS = at(form.shaft + form.head / 2),
         .halfSize = {form.headRadius, form.headRadius, form.head / 2},
         .color = arrow.color});
  }

  void addEllipsoid(const Ellipsoid& ellipsoid) {
    add({.mesh = MeshKind::kCapsule,
         .X_WS = ellipsoid.X_WE,
         .halfSize = drawnRadii(ellipsoid.radii),
         .color = ellipsoid.color});
  }

  DrawList take() {
    const auto distance = [&](const DrawItem& item) { return (item.X_WS.p - camera_.X_WC.p).squaredNorm(); };
    std::stable_sort(list_.translucent.begin(), list_.translucent.end(),
                     [&](const DrawItem& a, const DrawItem& b) { return distance(a) > distance(b); });
    return std::move(list_);
  }

 private:
  void add(DrawItem item) {
    if (item.halfSize.minCoeff() <= 0 || item.color.a <= 0) return;
    item.detail = detailFor(radiusInPixels(item, camera_, pictureHeight_));
    (item.color.a < 1 ? list_.translucent : list_.opaque).push_back(std::move(item));
  }

  void add(DrawItem item, const Solid& solid) {
    item.solid = solid_;
    item.X_WS = solid.X_WS;
    item.color = solid.color;
    add(std::move(item));
  }

  void addRoundedBox(const Solid& solid) {
    const Vector3d half = solid.shape.extent / 2;
    const double r = std::min(solid.shape.radius, half.minCoeff());
    if (!(r > 0)) return add({.mesh = MeshKind::kBox, .halfSize = half}, solid);
    add({.mesh = MeshKind::kRoundedBox, .halfSize = {r, r, r}, .stretch = half.array() - r}, solid);
  }

  void addMesh(const Solid& solid) {
    for (const TriangleMesh::Part& part : solid.shape.mesh.parts()) {
      DrawItem item{.mesh = MeshKind::kImported,
                    .X_WS = solid.X_WS,
                    .color = solid.color,
                    .solid = solid_,
                    .imported = solid.shape.mesh,
                    .firstTriangle = part.firstTriangle,
                    .triangleCount = part.triangleCount,
                    .texture = part.texture};
      if (part.color) {
        const Eigen::Vector4f& c = *part.color;
        item.color = {c[0], c[1], c[2], c[3] * solid.color.a};
      }
      add(std::move(item));
    }
  }

  const Camera& camera_;
  int pictureHeight_;
  int solid_ = -1;  // the index of the one being added
  DrawList list_;
};

}  // namespace

double radiusOf(const DrawItem& item) {
  if (item.mesh == MeshKind::kCapsule) return item.halfSize.maxCoeff();
  return std::max(item.halfSize.x(), item.halfSize.y());
}

Vector3d halfExtent(const DrawItem& item) {
  return item.mesh == MeshKind::kImported ? item.imported.halfBounds()
                                          : Vector3d(item.halfSize + item.stretch);
}

DrawList makeDrawList(const Picture& picture, const Camera& camera, int pictureHeight) {
  Builder builder(camera, pictureHeight);
  for (const Solid& solid : picture.solids)
    builder.addSolid(solid, static_cast<int>(&solid - picture.solids.data()));
  for (const Arrow& arrow : picture.arrows) builder.addArrow(arrow);
  for (const Ellipsoid& ellipsoid : picture.ellipsoids) builder.addEllipsoid(ellipsoid);
  return builder.take();
}

}  // namespace rex::internal
