#pragma once

#include "base/vector_arg.h"

namespace rex {

/// The convex hull of points in any dimension d, by its facets.
struct FacetHull {
  int dimension = 0;          ///< that the points fill; -1 without points
  Eigen::MatrixXd normals{};  ///< d x F: unit vectors, outward
  Eigen::VectorXd offsets{};  ///< F: normal.x of the outermost point
  double volume = 0;          ///< units of the points to the power d
};

/// The hull of the points (d x N, one per column). Facets only, and a volume, if the points fill all d
/// dimensions: what is thinner than a thousand-millionth of its size counts as flat. Facets of many corners
/// may come in pieces, and of points as near as a thousand-millionth of the size (measured along each axis of
/// inertia by the width there) one stands for all. Each offset is measured anew with all points, so none lies
/// outside. Throws Error for points of no numbers or of more than nine, for numbers that are not finite, and
/// for more than kMostFacetHullPoints.
[[nodiscard]] FacetHull facetHull(const MatrixArg& points);

inline constexpr int kMostFacetHullPoints = 10'000;

}  // namespace rex
