#pragma once

#include <string>

#include "planning/motion_limits.h"
#include "planning/timed_path.h"

namespace rex {

struct TimingOptions {
  double startSpeed = 0, endSpeed = 0;  ///< of the path's parameter, per second
  int intervals = 1000;                 ///< of the grid, at least; each piece has at least eight
  /// By how much, as a share of it, a limit may be exceeded between points of the grid: where it is in the
  /// middle of an interval, that is halved, up to six times. At the points of the grid limits hold.
  double excess = 0.01;
};

enum class TimingStatus {
  kFound,
  kInfeasible  ///< the message says where on the path, and which limits leave no speed
};

struct TimingResult {
  TimingStatus status = TimingStatus::kInfeasible;
  TimedPath motion{};  ///< the path at rest at its start if infeasible
  /// Seconds; no motion along the path is faster, because a coordinate would exceed its velocity.
  double lowerBound = 0;
  double excess = 0;  ///< the largest share of a limit, less one, in the middle of an interval; 0: none
  std::string message{};
};

/// The fastest motion along a path within limits (Pham and Pham 2018, TOPP-RA). With u the second derivative
/// and x the squared speed of the path's parameter, limits are rows a u + b x + c, at both ends of each
/// interval. Backwards over the grid goes the range of x from which the end can be reached, found by two
/// linear programs of two variables each; forwards the largest u that stays in the ranges.
/// Throws Error for limits of another size or that are not positive, efforts without forces, speeds and
/// options that make no sense, a path whose pieces do not join, and one with numbers that are not finite.
[[nodiscard]] TimingResult parametrizeTime(const PathCurve& curve, const MotionLimits& limits,
                                           const TimingOptions& options = {});

}  // namespace rex
