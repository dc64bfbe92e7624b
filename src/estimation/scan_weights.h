#pragma once

#include <vector>

#include <Eigen/Core>

#include "estimation/mixture_proposal.h"
#include "estimation/occupancy_map.h"
#include "estimation/particle_filter.h"

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

/// The likelihood of a range given the range expected from the map: a mixture of a Gaussian around the
/// expected range, readings without an echo, and random readings. Thrun, Burgard and Fox, Probabilistic
/// Robotics, section 6.3, without its term for unexpected people.
struct BeamModel {
  double deviation = 0.2;                      ///< standard deviation of the Gaussian, metres
  double bell = 0.9, none = 0.05, any = 0.05;  ///< mixture weights, which sum to one
  /// Rays of one scan are not independent: the sum of their log likelihoods is divided by this, at least 1.
  double temper = 1;
};

/// The weights for Monte Carlo localisation in a map (states are x, y, heading), given a scan. Keeps a
/// reference to the map. Throws Error for mixture weights out of range, a deviation that is not positive,
/// and like OccupancyMap::observe for ranges.
[[nodiscard]] LogLikelihood scanWeights(const OccupancyMap& map, RangeScanner scanner,
                                        const VectorArg& ranges, const BeamModel& model = {});

}  // namespace rex
