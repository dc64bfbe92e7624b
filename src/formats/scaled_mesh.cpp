#include "formats/scaled_mesh.h"

#include <fmt/format.h>

#include "formats/mesh_limits_internal.h"

namespace rex {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kLeastScale = 1e-9, kMostScale = 1e9;

void requireScale(const Vector3d& scale, const TriangleMesh& mesh, const std::string& name) {
  const Vector3d size = scale.cwiseAbs();
  if (!scale.allFinite() || size.minCoeff() < kLeastScale || size.maxCoeff() > kMostScale)
    mesh::fail(name, "scale of the mesh", fmt::format("({}, {}, {})", scale.x(), scale.y(), scale.z()),
               "numbers from 1e-9 to 1e9, or their negatives");
  const double reach = size.cwiseProduct(mesh.halfBounds()).maxCoeff();
  if (reach > mesh::kLargestCoordinate)
    mesh::fail(name, "scaled mesh", fmt::format("a vertex at {} m", reach), "at most 1e6 m");
}

}  // namespace

TriangleMesh scaledMesh(const TriangleMesh& mesh, const Vector3d& scale, const std::string& name) {
  requireScale(scale, mesh, name);
  if (scale == Vector3d::Ones()) return mesh;
  std::vector<Vector3f> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Vector3f> normals(mesh.normals().begin(), mesh.normals().end());
  std::vector<TriangleMesh::Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (Vector3f& p : positions) p = p.cast<double>().cwiseProduct(scale).cast<float>();
  // Normals scale by the inverse.
  for (Vector3f& n : normals) n = n.cast<double>().cwiseQuotient(scale).normalized().cast<float>();
  if ((scale.array() < 0).count() % 2 == 1)
    for (TriangleMesh::Triangle& corners : triangles) std::swap(corners[1], corners[2]);
  return {std::move(positions),
          std::move(normals),
          std::move(triangles),
          {mesh.parts().begin(), mesh.parts().end()},
          mesh.paint()};
}

TriangleMesh turnedMesh(const TriangleMesh& mesh, const Eigen::Matrix3d& R) {
  if (R.isIdentity(0)) return mesh;
  std::vector<Vector3f> positions(mesh.positions().begin(), mesh.positions().end());
  std::vector<Vector3f> normals(mesh.normals().begin(), mesh.normals().end());
  for (std::vector<Vector3f>* const all : {&positions, &normals})
    for (Vector3f& p : *all) p = (R * p.cast<double>()).cast<float>();
  return {std::move(positions),
          std::move(normals),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.parts().begin(), mesh.parts().end()},
          mesh.paint()};
}

}  // namespace rex
