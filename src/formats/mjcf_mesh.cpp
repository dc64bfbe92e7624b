#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"
#include "geometry/convex_hull.h"
#include "geometry/rotation.h"
#include "geometry/welded_mesh.h"

namespace rex::mjcf {
namespace {

using Eigen::Vector3f;
using Triangle = TriangleMesh::Triangle;

// The numbers of an attribute in groups of three.
Eigen::Matrix3Xd threes(const Tag& tag, const char* attribute, int least) {
  constexpr int kMostNumbers = 3'000'000;
  const Eigen::VectorXd numbers = tag.numbers(attribute, 3 * least, kMostNumbers);
  if (numbers.size() % 3 != 0)
    tag.failAt(attribute, fmt::format("{} numbers", numbers.size()), "three for each vertex or face");
  return numbers.reshaped(3, numbers.size() / 3);
}

Triangle cornersOf(const Tag& tag, const Eigen::Vector3d& face, std::size_t vertices) {
  Triangle corners{};
  for (int k = 0; k < 3; ++k) {
    if (!(face[k] >= 0 && face[k] < static_cast<double>(vertices) && face[k] == std::floor(face[k])))
      tag.failAt("face", fmt::format("a corner {}", face[k]),
                 fmt::format("whole numbers from 0 to {}, one below the number of vertices", vertices - 1));
    corners[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(face[k]);
  }
  return corners;
}

// The unit sphere: an icosahedron whose triangles are cut into four so many times.
TriangleMesh icosphere(int cuts) {
  constexpr float kGolden = 1.618033988749895f;
  std::vector<Vector3f> points;
  for (const float one : {-1.f, 1.f})
    for (const float golden : {-kGolden, kGolden})
      for (int axis = 0; axis < 3; ++axis) {
        Vector3f& point = points.emplace_back(Vector3f::Zero());
        point[axis] = one;
        point[(axis + 1) % 3] = golden;
      }
  for (Vector3f& point : points) point.normalize();
  const TriangleMesh first = convexHull(points);
  points.assign(first.positions().begin(), first.positions().end());
  std::vector<Triangle> triangles(first.triangles().begin(), first.triangles().end());
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (isNew) points.push_back((points[a] + points[b]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  return weldedMesh(points, triangles);
}

}  // namespace

TriangleMesh meshInTag(const Tag& tag) {
  if (tag.has("builtin") && tag.text("builtin") != "none") {
    constexpr double kMostCuts = 4;
    if (tag.text("builtin") != "sphere")
      tag.failAt("builtin", xml::quoted(tag.text("builtin")), "sphere, or a mesh in a file");
    const double cuts = tag.number("params");
    if (!(cuts >= 0 && cuts <= kMostCuts && cuts == std::floor(cuts)))
      tag.failAt("params", xml::quoted(tag.text("params")), "a whole number from 0 to 4");
    return icosphere(static_cast<int>(cuts));
  }
  if (!tag.has("vertex")) return {};
  constexpr int kFewestVertices = 4;
  std::vector<Vector3f> points;
  const Eigen::Matrix3Xd vertices = threes(tag, "vertex", kFewestVertices);
  for (const auto& point : vertices.colwise()) points.emplace_back(point.cast<float>());
  if (!tag.has("face")) return convexHull(points);
  std::vector<Triangle> triangles;
  const Eigen::Matrix3Xd faces = threes(tag, "face", 1);
  for (const auto& face : faces.colwise()) triangles.push_back(cornersOf(tag, face, points.size()));
  TriangleMesh mesh = weldedMesh(points, triangles);
  if (mesh.isEmpty()) tag.failAt("face", "triangles without an area", "a surface");
  return mesh;
}

Pose placeOfMesh(const Tag& tag, Eigen::Vector3d& scale) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (tag.has("refquat")) {
    const Eigen::Vector4d q = tag.numbers("refquat", 4);
    if (!(q.stableNorm() > 1e-100 && q.stableNorm() < 1e100))
      tag.failAt("refquat", xml::quoted(tag.text("refquat")), "a quaternion w x y z");
    R = rotationFromQuaternion(q.stableNormalized());
  }
  const Eigen::Matrix3d along = R * scale.asDiagonal() * R.transpose();
  const Eigen::Matrix3d stretched = along.diagonal().asDiagonal();
  if (!(along - stretched).isZero(1e-9 * scale.cwiseAbs().maxCoeff()))
    tag.failAt("refquat", "a 'scale' that differs along the turned axes", "one factor for all axes");
  scale = along.diagonal();
  const Eigen::Vector3d p =
      tag.has("refpos") ? Eigen::Vector3d(tag.numbers("refpos", 3)) : Eigen::Vector3d::Zero();
  return {R.transpose(), -(R.transpose() * scale.cwiseProduct(p))};
}

}  // namespace rex::mjcf
