#include "geometry/convex_hull.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "geometry/convex_hull_internal.h"

namespace rex {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Index = std::uint32_t;
using Triangle = TriangleMesh::Triangle;

// If their thickness is below this share of their size, points count as lying in a plane, on a line or at
// one point.
constexpr double kFlat = 1e-7;

// Relative to the centre of their box, so that positions far from the origin lose no digits; without
// duplicates.
struct Points {
  std::vector<Vector3d> at;
  std::vector<Index> index;  // of the first point at that position
};

Points distinct(std::span<const Vector3f> points) {
  Points all;
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](Index i) { return std::array{points[i].x(), points[i].y(), points[i].z()}; };
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return key(a) < key(b); });
  order.erase(std::unique(order.begin(), order.end(), [&](Index a, Index b) { return key(a) == key(b); }),
              order.end());
  Eigen::AlignedBox3d box;
  for (const Index i : order) box.extend(points[i].cast<double>());
  for (const Index i : order) all.at.push_back(points[i].cast<double>() - box.center());
  all.index = std::move(order);
  return all;
}

template <class Measure>
std::size_t farthest(const std::vector<Vector3d>& points, const Measure& measure) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double m = measure(points[i]); m > most) most = m, best = i;
  return best;
}

// How many dimensions the points fill, with the line or plane if it is one or two.
struct Extent {
  int dimension = 0;
  std::array<std::size_t, 2> ends{};  // two points far from each other
  Vector3d direction = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
};

Extent extentOf(const std::vector<Vector3d>& points) {
  Extent extent;
  const auto awayFrom = [&](const Vector3d& p) {
    return farthest(points, [&](const Vector3d& q) { return (q - p).squaredNorm(); });
  };
  extent.ends[0] = awayFrom(points[0]);
  const Vector3d& a = points[extent.ends[0]];
  extent.ends[1] = awayFrom(a);
  const Vector3d span = points[extent.ends[1]] - a;
  const double size = span.norm();
  if (size == 0) return extent;
  extent.direction = span / size;
  const Vector3d& third = points[farthest(
      points, [&](const Vector3d& q) { return extent.direction.cross(q - a).squaredNorm(); })];
  const Vector3d across = extent.direction.cross(third - a);
  extent.dimension = 1;
  if (!(across.norm() > kFlat * size)) return extent;
  extent.normal = across.normalized();
  const Vector3d& fourth =
      points[farthest(points, [&](const Vector3d& q) { return std::abs(extent.normal.dot(q - a)); })];
  extent.dimension = std::abs(extent.normal.dot(fourth - a)) > kFlat * size ? 3 : 2;
  return extent;
}

// The triangles of a polygon, seen from where its corners run counter-clockwise.
void addFan(const std::vector<Index>& corners, std::vector<Triangle>& triangles) {
  for (std::size_t k = 2; k < corners.size(); ++k)
    triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

// The corners of the hull in the plane, by Andrew's chain of left turns.
std::vector<Index> flatHull(const std::vector<Vector3d>& points, const Extent& extent) {
  const Vector3d u = extent.direction, v = extent.normal.cross(u);
  std::vector<Eigen::Vector2d> flat;
  for (const Vector3d& p : points) flat.emplace_back(u.dot(p), v.dot(p));
  std::vector<Index> order(points.size()), chain;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return flat[a].x() != flat[b].x() ? flat[a].x() < flat[b].x() : flat[a].y() < flat[b].y();
  });
  const double size = (points[extent.ends[1]] - points[extent.ends[0]]).norm();
  const auto turnsLeft = [&](Index a, Index b, Index c) {
    const Eigen::Vector2d s = flat[b] - flat[a], t = flat[c] - flat[a];
    return s.x() * t.y() - s.y() * t.x() > 1e-12 * size * t.norm();
  };
  for (int way = 0; way < 2; ++way) {
    const std::size_t start = std::max<std::size_t>(chain.size(), 1);
    for (const Index i : order) {
      while (chain.size() > start && !turnsLeft(chain[chain.size() - 2], chain.back(), i)) chain.pop_back();
      if (chain.empty() || chain.back() != i) chain.push_back(i);
    }
    std::reverse(order.begin(), order.end());
  }
  chain.pop_back();
  return chain;
}

// Both sides, cut into triangles in different ways, so that no inner edge is shared by four triangles.
std::vector<Triangle> bothSides(std::vector<Index> polygon) {
  std::vector<Triangle> triangles;
  addFan(polygon, triangles);
  std::reverse(polygon.begin(), polygon.end());
  std::rotate(polygon.begin(), polygon.end() - 2, polygon.end());
  addFan(polygon, triangles);
  return triangles;
}

std::vector<Triangle> trianglesOf(internal::Qhull& qhull) {
  std::vector<Triangle> triangles;
  qhT* qh = &qhull.state();  // the name that qhull's macros expect
  facetT* facet;
  FORALLfacets {
    std::vector<Index> corners;
    setT* ordered = qh_facet3vertex(qh, facet);
    vertexT *vertex, **vertexp;
    FOREACHvertex_(ordered) corners.push_back(static_cast<Index>(qh_pointid(qh, vertex->point)));
    qh_settempfree(qh, &ordered);
    std::reverse(corners.begin(), corners.end());  // qhull goes round clockwise
    addFan(corners, triangles);
  }
  return triangles;
}

// If rounding defeats qhull, it may shift the points by some ulps.
std::vector<Triangle> solidHull(std::vector<Vector3d>& points) {
  for (const char* options : {"qhull C-0 Q12 Pp", "qhull QJ Pp"}) {
    internal::Qhull qhull;
    if (qhull.run(3, static_cast<int>(points.size()), points.front().data(), options))
      return trianglesOf(qhull);
  }
  assert(false && "points that fill space have a hull");
  return {};
}

// The points that are corners of the triangles. Triangles that face away from `front` do not contribute to
// normals.
TriangleMesh meshOf(std::span<const Vector3f> points, const Points& all, std::vector<Triangle> triangles,
                    const Vector3d& front) {
  constexpr Index kUnused = ~Index{0};
  std::vector<Index> vertexOf(all.at.size(), kUnused);
  std::vector<Vector3f> positions;
  std::vector<Vector3d> sums;
  for (Triangle& triangle : triangles) {
    const auto [a, b, c] = triangle;
    Vector3d normal = (all.at[b] - all.at[a]).cross(all.at[c] - all.at[a]);
    if (normal.dot(front) < 0) normal.setZero();
    for (Index& corner : triangle) {
      Index& vertex = vertexOf[corner];
      if (vertex == kUnused) {
        vertex = static_cast<Index>(positions.size());
        positions.push_back(points[all.index[corner]]);
        sums.push_back(Vector3d::Zero());
      }
      sums[vertex] += normal;
      corner = vertex;
    }
  }
  std::vector<Vector3f> normals;
  for (const Vector3d& sum : sums) normals.push_back(sum.normalized().cast<float>());
  return {std::move(positions), std::move(normals), std::move(triangles)};
}

}  // namespace

TriangleMesh convexHull(std::span<const Vector3f> points) {
  requireSurface({points.begin(), points.end()}, {}, {});
  if (points.empty()) return {};
  Points all = distinct(points);
  if (all.at.size() > kMostHullPoints)
    throw Error({.what = "convex hull",
                 .found = fmt::format("{} different points", all.at.size()),
                 .wanted = fmt::format("at most {}", kMostHullPoints)});
  const Extent extent = extentOf(all.at);
  if (extent.dimension < 2) {
    std::vector<Vector3f> ends = {points[all.index[extent.ends[0]]]};
    if (extent.dimension == 1) ends.push_back(points[all.index[extent.ends[1]]]);
    return {std::move(ends), {}, {}};
  }
  if (extent.dimension == 2) return meshOf(points, all, bothSides(flatHull(all.at, extent)), extent.normal);
  return meshOf(points, all, solidHull(all.at), Vector3d::Zero());
}

TriangleMesh convexHull(const TriangleMesh& mesh) { return convexHull(mesh.positions()); }

}  // namespace rex
