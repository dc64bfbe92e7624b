#pragma once

#include "estimation/occupancy_map.h"
#include "estimation/particle_filter.h"

namespace rex {

/// How likely a range is where the map says another: mixed of a bell around what it says, readings without an
/// echo, and any reading. Thrun, Burgard and Fox, Probabilistic Robotics, section 6.3, without its term for
/// unexpected people.
struct BeamModel {
  double deviation = 0.2;                      ///< of the bell, metres
  double bell = 0.9, none = 0.05, any = 0.05;  ///< shares, which sum to one
  /// Rays of one scan are not independent: their sum counts divided by this, at least 1.
  double temper = 1;
};

/// The weights of Monte Carlo localisation in a map (states are x, y, heading) for what a scanner read. Keeps
/// a reference to the map. Throws Error for shares that do not fit, a deviation that is not positive, and
/// ranges as OccupancyMap::observe.
[[nodiscard]] Weigh scanWeights(const OccupancyMap& map, RangeScanner scanner, const VectorArg& ranges,
                                const BeamModel& model = {});

}  // namespace rex
