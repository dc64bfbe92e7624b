#pragma once

#include <span>

#include "grasping/wrench_cone.h"

namespace rex {

/// Where zero lies in the hull of the wrenches: kInside is force closure. kFlat: the hull fills fewer than d
/// dimensions. kEmpty: there are no wrenches.
enum class HullStatus { kInside, kOutside, kFlat, kEmpty };

/// How well wrenches hold, by their convex hull: the forces of all contacts together are one newton along
/// their normals (the grasps L1 of Ferrari and Canny, 1992). Slide 10:9.
struct GraspQuality {
  HullStatus status = HullStatus::kEmpty;
  int dimension = -1;  ///< that the hull fills
  /// Newtons: the radius of the largest ball around zero in the hull, so that every wrench that long can be
  /// counteracted. Zero unless kInside.
  double epsilon = 0;
  double volume = 0;  ///< N^d of the hull; zero if it is flat or empty
  /// d, unit: along it the wrenches reach least far, epsilon if kInside and at most zero if kOutside. Else
  /// empty.
  Eigen::VectorXd weakest{};
};

/// The quality of wrenches (d x N, one per column), by their exact hull. Known values, with one newton along
/// each normal and torques about the centre: two planar fingers on opposite sides, each at `length` of the
/// WrenchReference from the centre, epsilon = mu / sqrt(2 + mu^2); fingers at the centres of all faces of a
/// cube of half edge `length`, as exact cones or pyramids of 8 edges, mu sqrt(2/3), of 4 edges mu / sqrt(3);
/// four smooth planar fingers on a square with torques 1/2, 1/2, -1/2, -1/2, sqrt(1/8). Zero that is nearer
/// than 1e-12 of the longest wrench to a facet counts as outside. Throws Error as facetHull().
[[nodiscard]] GraspQuality graspQuality(const MatrixArg& wrenches);

/// The epsilon of exact friction cones lies between these, newtons.
struct EpsilonBounds {
  double atLeast = 0;                      ///< proven by the hull of edges
  double atMost = 0;                       ///< what the cones reach in one direction
  Eigen::VectorXd weakest{};               ///< that direction; empty if there are no cones, or none is known
  HullStatus status = HullStatus::kEmpty;  ///< of the hull of edges
};

/// Bounds at most `tolerance` apart, unless `mostRounds` end the search before: to the hull of edges those
/// wrenches are added that reach farthest along its lowest facets; with 0 rounds only along those of the
/// first hull. In space a round takes some tenths of a second once there are a hundred. Cones that are not
/// closed give zeros. Throws Error as primitiveWrenches() and facetHull(), for a tolerance that is not
/// positive, and for a negative number of rounds.
[[nodiscard]] EpsilonBounds exactEpsilon(std::span<const WrenchCone> cones, double tolerance = 1e-6,
                                         int mostRounds = 100);

}  // namespace rex
