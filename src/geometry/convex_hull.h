#pragma once

#include <cstddef>
#include <span>

#include "geometry/triangle_mesh.h"

namespace rex {

/// More different points are refused, so that no hull takes longer than a second.
inline constexpr std::size_t kMostHullPoints = 100'000;

/// The convex hull of points: a closed surface of outward triangles whose vertices are extreme points, each
/// once; normals are averages over the triangles at a vertex. The same points in the same order give the same
/// hull. What is thinner than a ten-millionth of its size counts as flat and gives a polygon with both its
/// sides, a straight line its two ends, a single place one point, the last two without triangles. No points
/// give nothing. Throws Error for a number that is not finite, and for more than kMostHullPoints.
[[nodiscard]] TriangleMesh convexHull(std::span<const Eigen::Vector3f> points);

/// The hull of all positions of a mesh.
[[nodiscard]] TriangleMesh convexHull(const TriangleMesh& mesh);

}  // namespace rex
