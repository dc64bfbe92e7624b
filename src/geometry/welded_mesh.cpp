#include "geometry/welded_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "geometry/welded_mesh_internal.h"

namespace rex {
namespace {

std::uint64_t hashOf(const Eigen::Vector3f& p) {
  std::uint64_t hash = 0;
  for (const float x : p)
    hash = (hash ^ std::bit_cast<std::uint32_t>(x + 0.f)) * 0x9e3779b97f4a7c15u;  // -0 is 0
  return hash;
}

}  // namespace

// Uses a hash table with linear probing, at least half of which stays free.
MeshPlaces findPlaces(std::span<const Eigen::Vector3f> positions) {
  constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();
  const auto bits = std::bit_width(2 * positions.size() + 1);
  std::vector<std::uint32_t> table(std::size_t{1} << bits, kFree);
  MeshPlaces places;
  places.placeOf.reserve(positions.size());
  for (const Eigen::Vector3f& p : positions) {
    std::size_t slot = hashOf(p) >> (64 - bits);
    while (table[slot] != kFree && places.positions[table[slot]] != p) slot = (slot + 1) % table.size();
    if (table[slot] == kFree) {
      table[slot] = static_cast<std::uint32_t>(places.positions.size());
      places.positions.push_back(p);
    }
    places.placeOf.push_back(table[slot]);
  }
  return places;
}

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Index = std::uint32_t;
using Triangle = TriangleMesh::Triangle;

struct Face {
  Triangle corners;
  Triangle given;  // the corners before welding
  Vector3d normal;
  std::array<double, 3> angles;  // at the corners, radians
};

// Empty for a triangle without area, or so thin that it has no normal.
std::optional<Face> makeFace(const MeshPlaces& welded, const Triangle& given) {
  constexpr double kFlatTriangle = 1e-9;
  Triangle corners = given;
  for (Index& corner : corners) corner = welded.placeOf[corner];
  const auto at = [&](int k) -> Vector3d { return welded.positions[corners[k % 3]].cast<double>(); };
  Face face{.corners = corners, .given = given, .normal = (at(1) - at(0)).cross(at(2) - at(0)), .angles = {}};
  double longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, (at(k + 1) - at(k)).squaredNorm());
  const double twiceArea = face.normal.norm();
  if (!(twiceArea > kFlatTriangle * longest)) return std::nullopt;
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

// Whether each edge is traversed once in each direction.
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
    std::swap(face.given[1], face.given[2]);
    std::swap(face.angles[1], face.angles[2]);
    face.normal = -face.normal;
  }
}

// A corner of a face.
struct Corner {
  Index face;
  int k;
};

// The corners that meet at each place: those of place i begin at first[i], and end where the next ones begin.
struct Meeting {
  std::vector<Index> first;
  std::vector<Corner> corners;

  std::span<const Corner> at(std::size_t place) const {
    return std::span(corners).subspan(first[place], first[place + 1] - first[place]);
  }
};

Meeting meetingAt(std::size_t placeCount, const std::vector<Face>& faces) {
  Meeting meeting{.first = std::vector<Index>(placeCount + 2, 0),
                  .corners = std::vector<Corner>(3 * faces.size())};
  for (const Face& face : faces)
    for (const Index place : face.corners) ++meeting.first[place + 2];
  std::partial_sum(meeting.first.begin(), meeting.first.end(), meeting.first.begin());
  for (Index i = 0; i < faces.size(); ++i)
    for (int k = 0; k < 3; ++k) meeting.corners[meeting.first[faces[i].corners[k] + 1]++] = {i, k};
  meeting.first.pop_back();
  return meeting;
}

// More corners at one place form a fan, which stays flat: comparing all pairs would take quadratic time.
constexpr std::size_t kMostMeeting = 256;

Vector3f normalAt(const Corner& corner, std::span<const Corner> meeting, const std::vector<Face>& faces,
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
                        const std::vector<TriangleMesh::Part>& parts, double creaseAngle,
                        TriangleMesh::Paint paint) {
  requireSurface(positions, triangles, parts);
  const std::vector<Eigen::Vector2f> given = std::move(paint.points);
  paint.points.clear();
  if (!given.empty() && given.size() != positions.size())
    throw Error({.what = "mesh",
                 .found = fmt::format("{} texture coordinates", given.size()),
                 .wanted = fmt::format("{}, one for each vertex, or none", positions.size())});
  const TriangleMesh::Part whole{.triangleCount = static_cast<Index>(triangles.size())};
  const MeshPlaces places = findPlaces(positions);
  std::vector<Face> faces;
  std::vector<TriangleMesh::Part> keptParts;
  for (TriangleMesh::Part part : parts.empty() ? std::vector{whole} : parts) {
    const std::size_t first = faces.size();
    for (Index i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      if (const auto face = makeFace(places, triangles[i])) faces.push_back(*face);
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
  const Meeting meeting = meetingAt(places.positions.size(), faces);
  for (std::size_t place = 0; place < places.positions.size(); ++place) {
    const std::span<const Corner> corners = meeting.at(place);
    const std::size_t first = normals.size();
    const bool isFan = corners.size() > kMostMeeting;
    for (const Corner& corner : corners) {
      const Vector3f normal = isFan ? Vector3f(faces[corner.face].normal.cast<float>())
                                    : normalAt(corner, corners, faces, leastCosine);
      std::size_t vertex = isFan ? normals.size() : first;
      const Index position = faces[corner.face].given[corner.k];
      const auto isOther = [&](std::size_t known) {
        return (normals[known] - normal).squaredNorm() > kSame ||
               (!given.empty() && paint.points[known] != given[position]);
      };
      while (vertex < normals.size() && isOther(vertex)) ++vertex;
      if (vertex == normals.size()) {
        vertices.push_back(places.positions[place]);
        normals.push_back(normal);
        if (!given.empty()) paint.points.push_back(given[position]);
      }
      kept[corner.face][corner.k] = static_cast<Index>(vertex);
    }
  }
  return {std::move(vertices), std::move(normals), std::move(kept), std::move(keptParts), std::move(paint)};
}

}  // namespace rex
