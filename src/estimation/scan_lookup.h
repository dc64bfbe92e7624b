#pragma once

#include <vector>

#include <Eigen/Core>

#include "estimation/mixture_proposal.h"
#include "estimation/occupancy_map.h"

namespace rex {

/// The scans expected in a known map at the centres of a grid of poses (x, y, heading; metres, radians): what
/// a scan alone says about the pose, for mixtureProposal() to draw from. Slide 7:25; Thrun, Fox, Burgard and
/// Dellaert 2001.
class ScanLookup {
 public:
  /// Poses in free cells of the map, `cell` metres apart, with `headings` headings each. Memory: 4 bytes per
  /// pose and ray. Throws Error for a cell that is not positive, no headings, more than 1e7 poses, no pose
  /// in a free cell, and like OccupancyMap::scan.
  ScanLookup(const OccupancyMap& map, const RangeScanner& scanner, double cell = 0.4, int headings = 24);

  const StateGrid& grid() const { return grid_; }
  /// The same density in all cells whose centre is free, and none elsewhere.
  [[nodiscard]] StateDensity anywhere() const;
  /// In each of these cells in proportion to exp(-sum / (2 temper)), where the sum is over all rays of the
  /// squared difference to the expected range at the centre, in units of `deviation` (metres), at most 3^2.
  /// Wide cells want a large deviation. Throws Error for numbers that are not positive, and like scanWeights
  /// for ranges.
  [[nodiscard]] StateDensity given(const VectorArg& ranges, double deviation = 0.5, double temper = 3) const;

 private:
  RangeScanner scanner_;
  StateGrid grid_;
  std::vector<int> free_;     // cells of the grid
  Eigen::MatrixXf expected_;  // the ranges there, one scan per column
};

}  // namespace rex
