#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

#include "render/own_ground_internal.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

// Shares of the scene's radius. With the planes that framing() sets, a step of the depth buffer is less
// than a ten-thousandth of it.
constexpr double kThin = 5e-4, kLowered = 1e-3, kAbout = 0.02;

double areaFromAbove(const Bounds& box) { return (box.high - box.low).head<2>().prod(); }

bool isSurface(const Solid& solid) {
  const ShapeType type = solid.shape.type;
  if (solid.color.a <= 0 || type == ShapeType::kMarker || type == ShapeType::kPointCloud) return false;
  return !usesMesh(type) || !solid.shape.mesh.triangles().empty();
}

// A cheap lower bound on its height: that of the box around the origin of its frame.
double lowestOf(const Solid& solid) {
  const Vector3d half = usesMesh(solid.shape.type)
                            ? Vector3d(solid.shape.mesh.halfBounds() + Vector3d::Constant(solid.shape.radius))
                            : halfBounds(solid.shape);
  return solid.X_WS.p.z() - solid.X_WS.R.row(2).cwiseAbs().dot(half);
}

// The area, in square metres, of the triangles of a mesh that face up at that height in W.
double floorArea(const Solid& solid, double height, double tolerance) {
  double area = 0;
  const std::span<const Eigen::Vector3f> positions = solid.shape.mesh.positions();
  const Eigen::RowVector3d up = solid.X_WS.R.row(2);
  const auto isAt = [&](std::uint32_t vertex) {
    return std::abs(up.dot(positions[vertex].cast<double>()) + solid.X_WS.p.z() - height) <= tolerance;
  };
  for (const auto& [a, b, c] : solid.shape.mesh.triangles()) {
    if (!isAt(a) || !isAt(b) || !isAt(c)) continue;
    const Vector3d first = positions[a].cast<double>(),
                   twice = (positions[b].cast<double>() - first).cross(positions[c].cast<double>() - first);
    area += std::max(0., up.dot(twice) / 2);
  }
  return area;
}

}  // namespace

std::optional<double> checkerHeight(const Picture& picture, const Bounds& scene) {
  const double height = picture.ground.height;
  if (!picture.ground.visible) return std::nullopt;
  if (scene.isEmpty()) return height;
  const double thin = kThin * scene.radius(), about = kAbout * scene.radius();
  const double large = areaFromAbove(scene) / 2;
  bool isLowered = false;
  for (const Solid& solid : picture.solids) {
    if (!isSurface(solid) || lowestOf(solid) > height + about) continue;
    const Bounds box = bounds(solid);
    const double above = box.high.z() - height;
    if (box.high.z() - box.low.z() <= thin) {
      const double area = areaFromAbove(box);
      if (area > 0 && area >= large && std::abs(above) <= about) return std::nullopt;
      isLowered |= area > 0 && std::abs(above) <= 2 * thin;
    } else if (usesMesh(solid.shape.type)) {
      const double area = floorArea(solid, height, thin);
      if (area > 0 && area >= large) return std::nullopt;
      isLowered |= area > 0;
    }
  }
  return isLowered ? height - kLowered * scene.radius() : height;
}

}  // namespace rex::internal
