#pragma once

#include <vector>

#include "locomotion/compass_gait.h"

namespace rex {

struct LimitCycleOptions {
  int maxIterations = 50;
  double tolerance = 1e-13;  ///< of the residual, relative to the largest entry of x
  double timeLimit = 10;     ///< seconds of each step of the walker
};

/// A gait that repeats itself from step to step.
struct LimitCycle {
  enum class Status {
    kFound,
    kFell,   ///< the walker cannot even make one step from the guess: see `message`
    kStuck,  ///< there is no Newton direction, or no step along it comes closer
    kIterationLimit,
    kNoGait  ///< nothing replaces the energy lost in impacts: level ground, uphill, or steps shorter than
             ///< 1e-9 rad
  };
  Status status = Status::kIterationLimit;
  Eigen::Vector4d x{0, 0, 0, 0};  ///< just after an impact; if not found, the closest attempt
  double period = 0;              ///< seconds of one step
  /// The eigenvalues of the step map's derivative at x, by decreasing modulus: how much a small change of
  /// the state grows per step. One of the four is zero, because both feet are on the slope at an impact.
  Eigen::Vector4cd multipliers = Eigen::Vector4cd::Zero();
  bool isStable = false;  ///< found, and all moduli below one
  double residual = 0;    ///< max |step(x) - x|
  int iterations = 0;
  std::string message{};
};

/// The limit cycle near `guess`, a state just after an impact: Newton's method on the step map with its
/// exact derivative, damped if the walker would fall or come no closer (slide 11:20; McGeer 1990). It also
/// finds unstable gaits. Throws Error like CompassGait, and for options that are not positive.
[[nodiscard]] LimitCycle findLimitCycle(const CompassGait& walker, const Eigen::Vector4d& guess,
                                        const LimitCycleOptions& options = {});

}  // namespace rex
