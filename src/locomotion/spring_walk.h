#pragma once

#include <array>
#include <complex>
#include <string>
#include <vector>

#include "systems/spring_leg.h"

namespace rex {

/// A walker whose mass is straight above its only foot on the ground: metres above it, m/s forward and
/// upward.
struct MidStance {
  double height = 1, speed = 1, rise = 0;
};

/// How a step ended.
enum class WalkStatus {
  kStepped,
  kTooLow,    ///< the mass is too low to set the other leg at its angle
  kTookOff,   ///< no foot was on the ground, or the front leg lifted off first: no walk
  kFell,      ///< the mass reached the ground
  kRushed,    ///< the mass passed the front foot before the hind leg lifted off
  kTimeLimit  ///< the mass did not reach the front foot in time; perhaps it turned back
};

/// One step, and how it ended. States are (x, y, their rates), x forward from the foot that is left.
struct WalkStep {
  WalkStatus status = WalkStatus::kTimeLimit;
  MidStance next{};                       ///< above the front foot, if kStepped
  double time = 0;                        ///< seconds from mid-stance to mid-stance, or until the end
  double doubleTime = 0;                  ///< the part of it with both feet on the ground, seconds
  double length = 0;                      ///< from foot to foot, metres
  Eigen::Vector4d touchdown{0, 0, 0, 0};  ///< of the front leg
  Eigen::Vector4d takeoff{0, 0, 0, 0};    ///< of the hind leg
  std::string message{};                  ///< for example "fell after 0.4 s"
};

inline constexpr double kLongestPhase = 5;  ///< seconds

/// A step of a point mass on two springy legs without mass, each as `leg`, whose `angle` is that of the front
/// leg at touchdown: slide 11:23; Geyer, Seyfarth, Blickhan 2006, Compliant leg behaviour explains basic
/// dynamics of walking and running. Throws Error like SpringLeg, and for a time limit (seconds, for each
/// phase) that is not positive.
[[nodiscard]] WalkStep walkStep(const SpringLeg& leg, const MidStance& from,
                                double timeLimit = kLongestPhase);

/// Joules, of a walker at mid-stance: it does not change.
[[nodiscard]] double totalEnergy(const SpringLeg& leg, const MidStance& at);

/// The walker at one time of a step, and how its legs push.
struct WalkSample {
  double time = 0;                ///< seconds since mid-stance
  Eigen::Vector4d x{0, 0, 0, 0};  ///< as in WalkStep
  Eigen::Vector2d hind{0, 0};     ///< N, force on the mass of the leg that is left
  Eigen::Vector2d front{0, 0};    ///< of the other
};

/// A step in samples, `count` for each of its phases (one foot, both feet, the other foot), as far as it
/// goes. Throws Error like walkStep() and for a count below 2.
[[nodiscard]] std::vector<WalkSample> walkSamples(const SpringLeg& leg, const MidStance& from, int count);

/// A walking gait: a mid-stance that a step reproduces.
struct WalkingGait {
  enum class Status {
    kFound,
    kFell,   ///< the walker cannot even make one step from the guess: see `message`
    kStuck,  ///< no step along Newton's direction comes closer
    kIterationLimit
  };
  Status status = Status::kIterationLimit;
  MidStance at{};
  /// For height and rise at constant energy: how much a small change grows per step.
  std::array<std::complex<double>, 2> multipliers{};
  bool isStable = false;  ///< both moduli are below one
  double residual = 0;    ///< the larger change of height (m) and rise (m/s) in a step
  int iterations = 0;
  std::string message{};
};

/// The gait near `guess` with the same energy, by damped Newton steps on the map from one mid-stance to the
/// next. Throws Error like walkStep().
[[nodiscard]] WalkingGait findWalkingGait(const SpringLeg& leg, const MidStance& guess);

}  // namespace rex
