#pragma once

#include <vector>

#include <Eigen/Core>

#include "estimation/occupancy_map.h"

namespace rex {

class Rng;

/// A building seen from above, in which robots with range scanners are simulated.
struct Building {
  std::vector<Eigen::Vector4d> walls{};  ///< straight, (x1, y1, x2, y2), metres

  /// Adds four sides; (x, y) is the lower left corner.
  void addBox(double x, double y, double width, double height);
};

/// Metres from p along the angle to the first wall, at most maxRange.
[[nodiscard]] double distanceToWall(const Building& building, const Eigen::Vector2d& p, double angle,
                                    double maxRange);

/// The readings of a scanner at a pose (x, y, heading), with normal noise of this standard deviation. Throws
/// Error like OccupancyMap::scan, and for a deviation that is negative or not finite.
[[nodiscard]] Eigen::VectorXd noisyRanges(const Building& building, const RangeScanner& scanner,
                                          const Eigen::Vector3d& pose, double deviation, Rng& rng);

/// Marks all cells of the map through which a wall passes as occupied, and all others as free.
void rasterize(const Building& building, OccupancyMap& map);

/// A floor of 24 x 16 m from the origin, without symmetry: rooms, and a corridor around a closed block.
[[nodiscard]] Building officeBuilding();
/// The corners of a walk in it that goes once around the block, visits two rooms, and comes back.
[[nodiscard]] std::vector<Eigen::Vector2d> officeWalk();
/// A map of its size in which nothing is known. Outer walls lie in the middle of cells if their size (metres)
/// divides half a metre.
[[nodiscard]] OccupancyMap emptyOffice(double cellSize);

}  // namespace rex
