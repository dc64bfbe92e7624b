#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// What a range scanner on a planar robot measures: one distance along each direction.
struct RangeScanner {
  std::vector<double> angles{};  ///< angles of the rays, from the robot's heading, radians
  double maxRange = 10;          ///< metres; the reading of a ray that hits nothing closer
};

/// The inverse sensor model of one ray, for the cell that stopped it and for cells it passed.
struct RayEvidence {
  double hit = 0.85, miss = 0.3;  ///< probabilities of being occupied, hit above and miss below one half
  double bound = 0.999;           ///< limit on the certainty of a cell, so that it can change again
};

/// A grid of square cells, each with the log odds of being occupied; 0: unknown. Slide 7:33; Moravec and
/// Elfes 1985. Cell (0, 0) has its lower left corner at the origin.
class OccupancyMap {
 public:
  /// Throws Error for fewer than one cell or more than 1e8, a cell size that is not positive, and an origin
  /// that is not finite.
  OccupancyMap(int width, int height, double cellSize, const Eigen::Vector2d& origin = {0, 0});

  int width() const { return width_; }
  int height() const { return height_; }
  double cellSize() const { return cellSize_; }
  const Eigen::Vector2d& origin() const { return origin_; }

  bool contains(int x, int y) const { return 0 <= x && x < width_ && 0 <= y && y < height_; }
  /// The log odds of a cell that the map contains.
  [[nodiscard]] double logOdds(int x, int y) const { return cells_[place(x, y)]; }
  void setLogOdds(int x, int y, double logOdds) { cells_[place(x, y)] = logOdds; }
  [[nodiscard]] double probability(int x, int y) const;
  bool isOccupied(int x, int y) const { return contains(x, y) && logOdds(x, y) > 0; }
  /// The cell of a point; it may lie outside the map. Throws Error for a point that is not finite.
  [[nodiscard]] Eigen::Vector2i cellAt(const Eigen::Vector2d& p) const;

  /// Metres from p along the angle to the first occupied cell, at most maxRange; 0 inside one. Cells are
  /// traversed exactly in order (Amanatides and Woo 1987). Throws Error for numbers that are not finite
  /// (maxRange may be infinite) and for a negative maxRange.
  [[nodiscard]] double distanceToOccupied(const Eigen::Vector2d& p, double angle, double maxRange) const;
  /// Computes the readings of a noise-free scanner at pose (x, y, heading). Throws Error if the number of
  /// ranges is not that of the scanner's rays, for a pose or angle that is not finite, and for a maxRange
  /// that is not finite and positive.
  void scan(const RangeScanner& scanner, const Eigen::Vector3d& pose,
            Eigen::Ref<Eigen::VectorXd> ranges) const;

  /// Adds the evidence of a scan to the cells along each ray. Throws Error like scan, for a range that is
  /// not finite or negative, and for evidence out of order; the map is unchanged then.
  void observe(const RangeScanner& scanner, const Eigen::Vector3d& pose, const VectorArg& ranges,
               const RayEvidence& evidence = {});

 private:
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_, height_;
  double cellSize_;
  Eigen::Vector2d origin_;
  std::vector<double> cells_;
};

/// How well the walls of two maps with the same cells agree.
struct MapAgreement {
  double precision = 0;  ///< share of the occupied cells that lie within `reach` of one of the truth
  double recall = 0;     ///< share of the cells of the truth, of those that were observed, that have one
  double overlap = 0;    ///< harmonic mean of both, zero if a map has no occupied cells
};
/// Compares occupied cells up to a distance of `reach` cells along each axis. A cell counts as observed if
/// the map knows anything about it. Throws Error for maps of different size and a negative reach.
[[nodiscard]] MapAgreement compareMaps(const OccupancyMap& map, const OccupancyMap& truth, int reach = 1);

}  // namespace rex
