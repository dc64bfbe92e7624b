#pragma once

#include "estimation/occupancy_map.h"
#include "estimation/particle_filter.h"

namespace rex {

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
[[nodiscard]] Weigh scanWeights(const OccupancyMap& map, RangeScanner scanner, const VectorArg& ranges,
                                const BeamModel& model = {});

}  // namespace rex
