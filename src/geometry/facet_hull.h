#pragma once

#include "base/require.h"

namespace rex {

/// The convex hull of points in any dimension d, by its facets.
struct FacetHull {
  int dimension = 0;          ///< dimension of the space that the points span; -1 without points
  Eigen::MatrixXd normals{};  ///< d x F: unit vectors, outward
  Eigen::VectorXd offsets{};  ///< F: normal.x of the outermost point
  double volume = 0;          ///< units of the points to the power d
};

/// The hull of the points (d x N, one per column). It has facets and a volume only if the points span all d
/// dimensions; a set thinner than 1e-9 of its size counts as flat. Facets with many corners may be split
/// into pieces. Points closer than 1e-9 of the size (along each axis of inertia, of the width there) are
/// merged, but each offset is computed from all points, so none lies outside. Throws Error unless d is 1 to
/// 9, for numbers that are not finite, and for more than kMostFacetHullPoints.
[[nodiscard]] FacetHull facetHull(const MatrixArg& points);

inline constexpr int kMostFacetHullPoints = 10'000;

}  // namespace rex
