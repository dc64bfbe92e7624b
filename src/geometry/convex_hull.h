#pragma once

#include <cstddef>
#include <span>

#include "geometry/triangle_mesh.h"

namespace rex {

/// More distinct points are refused, so that no hull takes longer than a second.
inline constexpr std::size_t kMostHullPoints = 100'000;

/// The convex hull of points: a closed surface of outward triangles whose vertices are extreme points, each
/// once. Normals are averages over the triangles at a vertex. The same points in the same order give the
/// same hull. A set thinner than a ten-millionth of its size counts as flat and gives a two-sided polygon;
/// a line gives its two ends, and coincident points give one point, both without triangles. The hull of no
/// points is empty. Throws Error for numbers that are not finite, and for more than kMostHullPoints.
[[nodiscard]] TriangleMesh convexHull(std::span<const Eigen::Vector3f> points);

/// The hull of all positions of a mesh.
[[nodiscard]] TriangleMesh convexHull(const TriangleMesh& mesh);

}  // namespace rex
