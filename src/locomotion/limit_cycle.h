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

struct BasinOptions {
  int maxSteps = 50;        ///< of each walker
  double tolerance = 1e-3;  ///< reached if no entry of the state differs by more from the cycle's
  double timeLimit = 10;    ///< seconds of each step
};

/// The outcome of one walk.
struct BasinOutcome {
  enum class Status {
    kReached,   ///< came within the tolerance once
    kFell,      ///< see `last`
    kUndecided  ///< walks on, but not into the cycle: converges too slowly, or to another gait
  };
  Status status = Status::kUndecided;
  StepStatus last = StepStatus::kStepped;  ///< how its last step ended
  int steps = 0;                           ///< whole steps until then
};

/// Finds out which starts lead into a limit cycle by walking from each column of `starts` (4 x N, states of
/// CompassGait after an impact). One outcome per column. Throws Error like CompassGait, for a cycle that
/// was not found or is not stable, as it attracts nothing, and for options that are not positive.
[[nodiscard]] std::vector<BasinOutcome> basinOfAttraction(const CompassGait& walker, const LimitCycle& cycle,
                                                          const Eigen::Ref<const Eigen::Matrix4Xd>& starts,
                                                          const BasinOptions& options = {});

/// Starts on a grid of stance angles and rates (radians, rad/s), stance angle varying fastest, with both
/// feet on the ground and the cycle's swing rate scaled with the stance rate: 4 x (angles * rates) states.
/// Throws Error for a cycle that was not found.
[[nodiscard]] Eigen::Matrix4Xd basinGrid(const CompassGait& walker, const LimitCycle& cycle,
                                         const Eigen::Ref<const Eigen::VectorXd>& stanceAngles,
                                         const Eigen::Ref<const Eigen::VectorXd>& stanceRates);

}  // namespace rex
