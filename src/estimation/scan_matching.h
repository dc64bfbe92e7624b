#pragma once

#include <string>

#include <Eigen/Core>

#include "estimation/occupancy_map.h"

namespace rex {

/// Where the rays of a scan ended, in the frame of the scanner and in the order of the rays: 2 x k, metres.
/// Rays that met nothing are left out. Throws Error as OccupancyMap::observe for ranges that do not fit.
[[nodiscard]] Eigen::Matrix2Xd scanPoints(const RangeScanner& scanner, const VectorArg& ranges);

struct ScanMatchOptions {
  double deviation = 0.02;   ///< of a range, metres
  double maxDistance = 0.5;  ///< points farther than this from all of the other scan have no partner, metres
  double maxGap = 0.5;       ///< neighbours in a scan that are farther apart are not on one wall, metres
  int maxIterations = 60;
  /// A direction counts as unseen if it has less than this share of what the best seen one has.
  double leastShare = 0.01;
};

enum class ScanMatchStatus {
  kConverged,
  kUnobservable,  ///< some direction is not seen, as along a corridor: there the motion is that of the guess
  kTooFewPoints,  ///< fewer than three partners, or no straight walls: the motion is the guess
  kBudgetSpent
};

/// A scan laid upon another.
struct ScanMatch {
  ScanMatchStatus status = ScanMatchStatus::kBudgetSpent;
  Eigen::Vector3d motion =
      Eigen::Vector3d::Zero();  ///< the moving scanner seen from the other: x, y, heading
  /// Of the motion, as PlanarEdge counts it; zero along what is not seen.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  /// kUnobservable: the unit vector (x, y, heading) along which the motion is seen least, its largest number
  ///< positive. Else zero.
  Eigen::Vector3d unseen = Eigen::Vector3d::Zero();
  double residual = 0;  ///< root mean square distance of the points that fit from their walls, metres
  double overlap = 0;   ///< share of the moving points that fit, of those which could
  int iterations = 0;
  std::string message{};
};

/// Aligns the points of a scan with those of a reference (2 x n, as scanPoints gives them), from a guess near
/// by: each point is drawn to the straight wall through its nearest neighbours; far ones count little (Censi
/// 2008, point-to-line ICP, with the weights of Geman and McClure). The information counts the noise of all
/// ranges of both scans (Censi 2007). Throws Error for numbers that are not finite and options that are not
/// positive.
[[nodiscard]] ScanMatch alignScans(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                                   const Eigen::Vector3d& guess, const ScanMatchOptions& options = {});

/// How far a guess may be off, to each side.
struct SearchWindow {
  double position = 1;   ///< along x and y, metres
  double heading = 0.5;  ///< radians
};

/// As alignScans, for guesses that are far off: tries all motions of a grid in the window, by how many points
/// come to lie on the reference (correlative matching; Olson 2009), and aligns from the best of them. Throws
/// as alignScans, and Error for a window that is negative or larger than 20 m or pi.
[[nodiscard]] ScanMatch searchAlignment(const Eigen::Matrix2Xd& reference, const Eigen::Matrix2Xd& moving,
                                        const Eigen::Vector3d& guess, const SearchWindow& window = {},
                                        const ScanMatchOptions& options = {});

}  // namespace rex
