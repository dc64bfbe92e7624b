#pragma once

#include <string>

#include "planning/timed_path.h"

namespace rex {

struct TimingOptions {
  double startSpeed = 0, endSpeed = 0;  ///< of the path's parameter, per second
  int intervals = 1000;                 ///< minimum for the grid; each piece has at least eight
  /// The fraction by which a limit may be exceeded between grid points. Intervals that exceed it in the
  /// middle are halved, up to six times. At the grid points limits hold.
  double excess = 0.01;
};

enum class TimingStatus {
  kFound,
  kInfeasible  ///< the message says where on the path, and which limits allow no speed
};

struct TimingResult {
  TimingStatus status = TimingStatus::kInfeasible;
  TimedPath motion{};  ///< if infeasible, the path at rest at its start
  /// Seconds: no motion along the path is faster, because a coordinate would exceed its velocity limit.
  double lowerBound = 0;
  double excess = 0;  ///< largest ratio to a limit in the middle of an interval, minus one; 0: none
  std::string message{};
};

/// The fastest motion along a path within limits (Pham and Pham 2018, TOPP-RA). With u the second
/// derivative and x the squared speed of the path parameter, limits are rows a u + b x + c at both ends of
/// each interval. A backward pass finds the ranges of x from which the end can be reached, with two linear
/// programs in two variables per interval. A forward pass takes the largest u that stays in them. Throws
/// Error for limits of the wrong size or not positive, effort limits without forces, speeds and options out
/// of range, and a path whose pieces do not join or are not finite.
[[nodiscard]] TimingResult parametrizeTime(const PathCurve& curve, const MotionLimits& limits,
                                           const TimingOptions& options = {});

}  // namespace rex
