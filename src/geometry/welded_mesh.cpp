#include "geometry/welded_mesh.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <Eigen/Geometry>

namespace rex {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Index = std::uint32_t;
using Triangle = TriangleMesh::Triangle;

struct HashPosition {
  std::size_t operator()(const std::array<float, 3>& p) const {
    std::size_t hash = 0;
    for (const float x : p) hash = (hash ^ std::hash<float>()(x)) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 32);
  }
};

// The distinct places, and which of them each position is.
struct Places {
  std::vector<Vector3f> positions;
  std::vector<Index> placeOf;
};

Places findPlaces(const std::vector<Vector3f>& positions) {
  Places places;
  std::unordered_map<std::array<float, 3>, Index, HashPosition> known;
  known.reserve(positions.size());
  for (const Vector3f& p : positions) {
    const auto [place, isNew] =
        known.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(places.positions.size()));
    if (isNew) places.positions.push_back(p);
    places.placeOf.push_back(place->second);
  }
  return places;
}

struct Face {
  Triangle corners;
  Vector3d normal;
  std::array<double, 3> angles;  // at the corners, radians
};

// None for a triangle without area, or so flat that it has no direction.
std::optional<Face> makeFace(const std::vector<Vector3f>& places, const Triangle& corners) {
  constexpr double kFlat = 1e-9;
  const auto at = [&](int k) -> Vector3d { return places[corners[k % 3]].cast<double>(); };
  Face face{.corners = corners, .normal = (at(1) - at(0)).cross(at(2) - at(0)), .angles = {}};
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, (at(k + 1) - at(k)).squaredNorm());
  const double twiceArea = face.normal.norm();
  if (!(twiceArea > kFlat * longest)) return std::nullopt;
  face.normal /= twiceArea;
  for (int k = 0; k < 3; ++k)
    face.angles[k] = std::atan2(twiceArea, (at(k + 1) - at(k)).dot(at(k + 2) - at(k)));
  return face;
}

double enclosedVolume(const std::vector<Vector3f>& places, const std::vector<Face>& faces) {
  if (faces.empty()) return 0;
  const Vector3d origin = places[faces[0].corners[0]].cast<double>();
  double six = 0;
  for (const Face& face : faces) {
    const auto at = [&](int k) -> Vector3d { return places[face.corners[k]].cast<double>() - origin; };
    six += at(0).dot(at(1).cross(at(2)));
  }
  return six / 6;
}

// Whether each edge is run along once in each direction.
bool isClosed(const std::vector<Face>& faces) {
  std::vector<std::uint64_t> edges, reversed;
  for (const Face& face : faces) {
    for (int k = 0; k < 3; ++k) {
      const std::uint64_t a = face.corners[k], b = face.corners[(k + 1) % 3];
      edges.push_back(a << 32 | b);
      reversed.push_back(b << 32 | a);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  return edges == reversed && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

void turnInsideOut(std::vector<Face>& faces) {
  for (Face& face : faces) {
    std::swap(face.corners[1], face.corners[2]);
    std::swap(face.angles[1], face.angles[2]);
    face.normal = -face.normal;
  }
}

// A corner of a face.
struct Corner {
  Index face;
  int k;
};

// The corners that meet at each place.
std::vector<std::vector<Corner>> cornersAtPlaces(std::size_t count, const std::vector<Face>& faces) {
  std::vector<std::vector<Corner>> corners(count);
  for (Index i = 0; i < faces.size(); ++i)
    for (int k = 0; k < 3; ++k) corners[faces[i].corners[k]].push_back({i, k});
  return corners;
}

// More corners at one place make a fan, which stays flat: to compare all with all would cost their square.
constexpr std::size_t kMostMeeting = 256;

Vector3f normalAt(const Corner& corner, const std::vector<Corner>& meeting, const std::vector<Face>& faces,
                  double leastCosine) {
  const Vector3d& own = faces[corner.face].normal;
  Vector3d sum = Vector3d::Zero();
  for (const Corner& other : meeting) {
    const Face& face = faces[other.face];
    if (face.normal.dot(own) >= leastCosine) sum += face.angles[other.k] * face.normal;
  }
  return (sum.norm() > 0 ? sum.normalized() : own).cast<float>();
}

}  // namespace

TriangleMesh weldedMesh(const std::vector<Vector3f>& positions, const std::vector<Triangle>& triangles,
                        const std::vector<TriangleMesh::Part>& parts, double creaseAngle) {
  requireSurface(positions, triangles, parts);
  const TriangleMesh::Part whole{.triangleCount = static_cast<Index>(triangles.size())};
  const Places places = findPlaces(positions);
  std::vector<Face> faces;
  std::vector<TriangleMesh::Part> keptParts;
  for (TriangleMesh::Part part : parts.empty() ? std::vector{whole} : parts) {
    const std::size_t first = faces.size();
    for (Index i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      Triangle corners = triangles[i];
      for (Index& corner : corners) corner = places.placeOf[corner];
      if (const auto face = makeFace(places.positions, corners)) faces.push_back(*face);
    }
    part.firstTriangle = static_cast<Index>(first);
    part.triangleCount = static_cast<Index>(faces.size() - first);
    if (part.triangleCount > 0) keptParts.push_back(part);
  }
  if (faces.empty()) return {};
  if (enclosedVolume(places.positions, faces) < 0 && isClosed(faces)) turnInsideOut(faces);

  constexpr float kSame = 1e-8f;
  const double leastCosine = std::cos(creaseAngle);
  std::vector<Vector3f> vertices, normals;
  std::vector<Triangle> kept(faces.size());
  const auto corners = cornersAtPlaces(places.positions.size(), faces);
  for (std::size_t place = 0; place < corners.size(); ++place) {
    const std::size_t first = normals.size();
    const bool isFan = corners[place].size() > kMostMeeting;
    for (const Corner& corner : corners[place]) {
      const Vector3f normal = isFan ? Vector3f(faces[corner.face].normal.cast<float>())
                                    : normalAt(corner, corners[place], faces, leastCosine);
      std::size_t vertex = isFan ? normals.size() : first;
      while (vertex < normals.size() && (normals[vertex] - normal).squaredNorm() > kSame) ++vertex;
      if (vertex == normals.size()) {
        vertices.push_back(places.positions[place]);
        normals.push_back(normal);
      }
      kept[corner.face][corner.k] = static_cast<Index>(vertex);
    }
  }
  return {std::move(vertices), std::move(normals), std::move(kept), std::move(keptParts)};
}

}  // namespace rex
