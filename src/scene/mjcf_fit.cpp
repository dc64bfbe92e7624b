#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

using Eigen::Vector3d;

// The principal axes of a mesh in its own frame, x that of the largest moment, and the half edges of the box
// of the same density that has its inertia.
struct Principal {
  Pose X_MP;
  Vector3d half;
};

Principal principalOf(const MassProperties& mesh) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(mesh.I_BBcm_B);
  const Vector3d moments = solver.eigenvalues().reverse();
  Principal all{{solver.eigenvectors().rowwise().reverse(), mesh.p_BBcm}, Vector3d::Zero()};
  if (all.X_MP.R.determinant() < 0) all.X_MP.R.col(2) *= -1;
  for (int i = 0; i < 3; ++i)
    all.half[i] = std::sqrt(std::max(0., 6 * (moments.sum() - 2 * moments[i]) / mesh.mass)) / 2;
  return all;
}

// A solid, and its pose in the frame of the mesh. Sizes as MuJoCo has them.
struct Fitted {
  Pose X_MS;
  Vector3d size;
};

// MuJoCo's capsule is longer than the box: its straight half is that of the box less half of the radius.
Fitted byInertia(Solid::Kind kind, const Principal& principal) {
  const Vector3d& half = principal.half;
  const double radius = (half.x() + half.y()) / 2;
  switch (kind) {
    case Solid::Kind::kSphere:
      return {principal.X_MP, {half.sum() / 3, 0, 0}};
    case Solid::Kind::kCapsule:
      return {principal.X_MP, {radius, std::max(0., half.z() - radius / 2), 0}};
    case Solid::Kind::kCylinder:
      return {principal.X_MP, {radius, half.z(), 0}};
    case Solid::Kind::kBox:
    case Solid::Kind::kEllipsoid:
    case Solid::Kind::kMesh:
      break;
  }
  return {principal.X_MP, half};
}

// Around all vertices, along the principal axes.
Fitted byBounds(Solid::Kind kind, const Principal& principal, const TriangleMesh& mesh) {
  std::vector<Vector3d> points;
  Vector3d low = Vector3d::Constant(HUGE_VAL), high = -low;
  const Pose X_PM = principal.X_MP.inverse();
  for (const Eigen::Vector3f& vertex : mesh.positions()) {
    points.emplace_back(X_PM * vertex.cast<double>());
    low = low.cwiseMin(points.back());
    high = high.cwiseMax(points.back());
  }
  const Vector3d center = (low + high) / 2;
  double radius = 0, reach = 0, half = 0;
  for (Vector3d& point : points) {
    point -= center;
    radius = std::max(radius, point.head<2>().norm());
    reach = std::max(reach, point.norm());
  }
  for (const Vector3d& point : points) {
    const double cap = std::sqrt(std::max(0., radius * radius - point.head<2>().squaredNorm()));
    half = std::max(half, std::abs(point.z()) - (kind == Solid::Kind::kCapsule ? cap : 0));
  }
  const Pose X_MS = principal.X_MP * Pose{Eigen::Matrix3d::Identity(), center};
  if (kind == Solid::Kind::kSphere) return {X_MS, {reach, 0, 0}};
  if (kind == Solid::Kind::kCapsule || kind == Solid::Kind::kCylinder) return {X_MS, {radius, half, 0}};
  return {X_MS, high - center};
}

Shape shapeOfFit(Solid::Kind kind, const Vector3d& size) {
  switch (kind) {
    case Solid::Kind::kSphere:
      return {.type = ShapeType::kSphere, .extent = Vector3d::Zero(), .radius = size[0]};
    case Solid::Kind::kCapsule:
      return {.type = ShapeType::kCapsule, .extent = {0, 0, 2 * size[1]}, .radius = size[0]};
    case Solid::Kind::kCylinder:
      return {.type = ShapeType::kCylinder, .extent = {0, 0, 2 * size[1]}, .radius = size[0]};
    case Solid::Kind::kEllipsoid:
      return {.type = ShapeType::kEllipsoid, .extent = 2 * size};
    case Solid::Kind::kBox:
    case Solid::Kind::kMesh:
      break;
  }
  return {.type = ShapeType::kBox, .extent = 2 * size};
}

}  // namespace

void fitGeoms(BodyTree& tree, const Compiler& compiler, Reading& reading) {
  for (const FitInTree& one : tree.fits) {
    ShapeSpec& shape = tree.shapesOf(one.at.body)[one.at.first];
    shape.contact = one.fit.contact;
    if (shape.meshMissing || shape.shape.mesh.isEmpty()) continue;
    const TriangleMesh mesh = shape.shape.mesh;
    const MassProperties properties = massOfMesh(shape, one.fit.inertia);
    if (!(properties.mass > 0)) {
      reading.notes.warn(shape.where, "<geom>: the mesh to fit encloses no volume, so nothing touches it");
      shape.contact = false;
      continue;
    }
    const Principal principal = principalOf(properties);
    Fitted fitted =
        compiler.fitsBounds ? byBounds(one.fit.kind, principal, mesh) : byInertia(one.fit.kind, principal);
    fitted.size *= one.fit.scale;
    shape.X_BS = shape.X_BS * fitted.X_MS;
    shape.shape = shapeOfFit(one.fit.kind, fitted.size);
    shape.meshFile.clear();
    shape.meshPath.clear();
    shape.meshScale.setOnes();
    if (!one.solid) continue;
    const auto body = std::ranges::find(tree.bodies, one.at.body, &BodyInFile::body);
    Solid& solid = body->solids[*one.solid];
    solid.kind = one.fit.kind;
    solid.size = fitted.size;
    solid.X_BS = shape.X_BS;
    solid.mesh.reset();
  }
}

}  // namespace rex::mjcf
