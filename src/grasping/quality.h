#pragma once

#include <span>

#include "grasping/wrench_cone.h"

namespace rex {

/// Where zero is in the hull of the wrenches: kInside means force closure. kFlat: the hull has fewer than d
/// dimensions. kEmpty: there are no wrenches.
enum class HullStatus { kInside, kOutside, kFlat, kEmpty };

/// The quality of a grasp, from the convex hull of its wrenches: the normal forces of all contacts sum to
/// one newton (the L1 metric of Ferrari and Canny, 1992). Slide 10:9.
struct GraspQuality {
  HullStatus status = HullStatus::kEmpty;
  int dimension = -1;  ///< of the hull
  /// Newtons: the radius of the largest ball around zero in the hull; every wrench of that length can be
  /// counteracted. Zero unless kInside.
  double epsilon = 0;
  double volume = 0;  ///< of the hull, N^d; zero if it is flat or empty
  /// The unit direction (d) along which the wrenches reach least: epsilon if kInside, at most zero if
  /// kOutside. Empty otherwise.
  Eigen::VectorXd weakest{};
};

/// The quality of wrenches (d x N, one per column), from their exact hull. Known values, for one newton
/// along each normal and torques about the centre: two planar fingers on opposite sides, each at `length`
/// of the WrenchReference from the centre, epsilon = mu / sqrt(2 + mu^2); fingers at the centres of all
/// faces of a cube of half edge `length`, as exact cones or pyramids of 8 edges, mu sqrt(2/3), of 4 edges
/// mu / sqrt(3); four smooth planar fingers on a square with torques 1/2, 1/2, -1/2, -1/2, sqrt(1/8). Zero
/// counts as outside if closer to a facet than 1e-12 of the longest wrench. Throws Error like facetHull().
[[nodiscard]] GraspQuality graspQuality(const MatrixArg& wrenches);

/// What the normal forces of the fingers are bounded by: their sum is at most one newton (the L1 metric of
/// Ferrari and Canny), or each is (their L-infinity metric).
enum class ForceBudget { kShared, kPerFinger };

/// Bounds on the epsilon of exact friction cones, newtons.
struct EpsilonBounds {
  double atLeast = 0;                      ///< proven by a hull of wrenches that the fingers can exert
  double atMost = 0;                       ///< what the cones reach along `weakest`
  Eigen::VectorXd weakest{};               ///< empty if there are no cones or no direction is known
  HullStatus status = HullStatus::kEmpty;  ///< of the hull of edges
};

/// Bounds at most `tolerance` apart, unless the search ends after `mostRounds`. Each round adds to the hull
/// of edges the wrenches that reach farthest along its lowest facets; 0 rounds use only the facets of the
/// first hull. In space, late rounds of a hundred take some tenths of a second each. The result is zero
/// without force closure. Throws Error like primitiveWrenches() and facetHull(), for a tolerance that is
/// not positive, and for a negative number of rounds.
[[nodiscard]] EpsilonBounds exactEpsilon(std::span<const WrenchCone> cones, double tolerance = 1e-6,
                                         int mostRounds = 100, ForceBudget budget = ForceBudget::kShared);

}  // namespace rex
