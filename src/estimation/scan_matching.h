#pragma once

#include <string>

#include <Eigen/Core>

#include "estimation/occupancy_map.h"

namespace rex {

/// The end points of a scan's rays in the scanner's frame, in the order of the rays: 2 x k, metres. Rays
/// that hit nothing are left out. Throws Error like OccupancyMap::observe for ranges that do not fit.
[[nodiscard]] Eigen::Matrix2Xd scanPoints(const RangeScanner& scanner, const VectorArg& ranges);

struct ScanMatchOptions {
  double deviation = 0.02;   ///< standard deviation of a range, metres
  double maxDistance = 0.5;  ///< points farther than this from the other scan have no partner, metres
  double maxGap = 0.5;       ///< neighbours in a scan that are farther apart are not on the same wall, metres
  int maxIterations = 60;
  /// A direction counts as unobservable if it has less than this fraction of the best direction's
  /// information.
  double leastShare = 0.01;
};

enum class ScanMatchStatus {
  kConverged,
  kUnobservable,  ///< some direction is not observable, as in a corridor: along it the motion is that of the
                  ///< guess
  kTooFewPoints,  ///< fewer than three partners, or no straight walls: the motion is the guess
  kBudgetSpent
};

/// The alignment of one scan with another.
struct ScanMatch {
  ScanMatchStatus status = ScanMatchStatus::kBudgetSpent;
  Eigen::Vector3d motion =
      Eigen::Vector3d::Zero();  ///< pose of the moving scanner in the reference frame: x, y, heading
  /// The information of the motion, as in PlanarEdge; zero along the unobservable direction.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// kUnobservable: the unit vector (x, y, heading) along which the motion is least observable, with a
  /// positive largest entry. Otherwise zero.
  Eigen::Vector3d unseen{0, 0, 0};
  double residual = 0;  ///< root mean square distance of the matched points from their walls, metres
  double overlap = 0;   ///< fraction of the moving points that match, among those that could
  int iterations = 0;
  std::string message{};
};

/// Aligns the points of a scan with those of a reference (2 x n, see scanPoints), starting from a nearby
/// guess. Point-to-line ICP: each point is matched with the line through its nearest neighbours; outliers
/// have little weight (Censi 2008, with Geman-McClure weights). The information accounts for the range
/// noise of both scans (Censi 2007). Throws Error for numbers that are not finite and options that are not
/// positive.
[[nodiscard]] ScanMatch alignScans(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                                   const Eigen::Vector3d& guess, const ScanMatchOptions& options = {});

/// How far a guess may be off, in each direction.
struct SearchWindow {
  double position = 1;   ///< along x and y, metres
  double heading = 0.5;  ///< radians
};

/// Like alignScans, for guesses that are far off: rates all motions of a grid in the window by how many
/// points lie on the reference (correlative matching; Olson 2009), and aligns from the best one. Throws
/// like alignScans, and for a window that is negative or larger than 20 m or pi.
[[nodiscard]] ScanMatch searchAlignment(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                                        const Eigen::Vector3d& guess, const SearchWindow& window = {},
                                        const ScanMatchOptions& options = {});

}  // namespace rex
