#pragma once

#include <numbers>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace rex {

/// Edges that bend by less than this look smooth, radians.
inline constexpr double kCreaseAngle = std::numbers::pi * 40 / 180;

/// A mesh with normals from plain triangles, as files hold them. Corners at the same position are merged,
/// triangles without area are dropped, and a closed surface that is inside out is inverted; otherwise the
/// winding stays. Normals are averages over the triangles at a corner, weighted by their angles there, that
/// bend by less than `creaseAngle`. `paint` has a point for each position; corners at one position with
/// different points become several vertices. Empty if no triangle is left. Throws Error as TriangleMesh.
[[nodiscard]] TriangleMesh weldedMesh(const std::vector<Eigen::Vector3f>& positions,
                                      const std::vector<TriangleMesh::Triangle>& triangles,
                                      const std::vector<TriangleMesh::Part>& parts = {},
                                      double creaseAngle = kCreaseAngle, TriangleMesh::Paint paint = {});

}  // namespace rex
