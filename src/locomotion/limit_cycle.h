#pragma once

#include "locomotion/compass_gait.h"

namespace rex {

struct LimitCycleOptions {
  int maxIterations = 50;
  double tolerance = 1e-13;  ///< found where a step changes no number of the state by more, times the largest
  double timeLimit = 10;     ///< seconds of each step of the walker
};

/// A gait that repeats itself from step to step.
struct LimitCycle {
  enum class Status {
    kFound,
    kFell,   ///< the walker does not even step from the guess: see `message`
    kStuck,  ///< no shorter way along Newton's direction comes nearer, or no direction
    kIterationLimit,
    kNoGait  ///< nothing replaces what impacts lose: level ground, uphill, or steps shorter than 1e-9 rad
  };
  Status status = Status::kIterationLimit;
  Eigen::Vector4d x = Eigen::Vector4d::Zero();  ///< just after an impact, as CompassGait; else the nearest
  double period = 0;                            ///< seconds of one step
  /// Of the step map at x, by falling modulus: by how much a small change of the state grows from step to
  /// step. One of the four is zero, because both feet stand on the slope at an impact.
  Eigen::Vector4cd multipliers = Eigen::Vector4cd::Zero();
  bool isStable = false;  ///< found, and all moduli below one
  double residual = 0;    ///< max |step(x) - x|
  int iterations = 0;
  std::string message{};
};

/// The limit cycle near `guess`, a state just after an impact: Newton's method on the step map with its exact
/// derivative, damped where the walker would fall or come no nearer (slide 11:20; McGeer 1990). It finds
/// unstable gaits, too. Throws Error as CompassGait, and for options that are not positive.
[[nodiscard]] LimitCycle findLimitCycle(const CompassGait& walker, const Eigen::Vector4d& guess,
                                        const LimitCycleOptions& options = {});

}  // namespace rex
