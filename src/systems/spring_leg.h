#pragma once

#include <string>

#include <Eigen/Core>

namespace rex {

/// A runner at the highest point of its flight: metres above the ground, m/s forward.
struct RunnerApex {
  double height = 1, speed = 5;
};

/// How a hop ended.
enum class HopStatus {
  kHopped,
  kNoTouchdown,  ///< the apex is too low to set the leg at its angle
  kFell,         ///< the mass reached the ground
  kNoRise,       ///< the foot lifted off, perhaps at once, while the mass moved down: no next apex
  kTimeLimit     ///< the leg did not extend again in time
};

/// One hop, and how it ended. States are (x, y, their rates), x forward from the foot, y from the ground.
struct Hop {
  HopStatus status = HopStatus::kTimeLimit;
  RunnerApex apex{};      ///< the next one, if kHopped
  double time = 0;        ///< seconds from apex to apex, or until the end
  double stanceTime = 0;  ///< the part of it on the ground, seconds
  Eigen::Vector4d touchdown{0, 0, 0, 0};
  Eigen::Vector4d takeoff{0, 0, 0, 0};  ///< or the end of stance otherwise
  std::string message{};                ///< for example "fell after 0.4 s"
};

/// A point mass on a massless, springy leg: slide 11:23; Blickhan 1989, The spring-mass model for running
/// and hopping; Geyer, Seyfarth, Blickhan 2006. In flight the leg is held at `angle`. Functions throw Error
/// for constants that are not positive, an angle of pi/2 or more, and numbers that are not finite.
struct SpringLeg {
  double mass = 80;                   ///< kg
  double stiffness = 20000;           ///< N/m
  double restLength = 1;              ///< metres
  double angle = 1.1868238913561442;  ///< between leg and ground at touchdown, radians; 68 degrees
  double g = 9.81;                    ///< m/s^2

  /// The derivative of a state in stance. Beyond the rest length, where stance has ended, the spring would
  /// pull.
  [[nodiscard]] Eigen::Vector4d stanceDerivative(const Eigen::Vector4d& x) const;
  /// Joules: kinetic and potential energy, and that of the spring in stance.
  [[nodiscard]] double stanceEnergy(const Eigen::Vector4d& x) const;
  [[nodiscard]] double apexEnergy(const RunnerApex& apex) const;
  /// Simulates from apex to apex: flight in closed form, stance with its end to machine precision. Stance
  /// may last `timeLimit` seconds.
  [[nodiscard]] Hop hop(const RunnerApex& apex, double timeLimit = 5) const;
};

/// A running gait: an apex that a hop reproduces.
struct RunningGait {
  enum class Status {
    kFound,
    kFell,   ///< the runner cannot even hop once from the guess, or turns back: see `message`
    kStuck,  ///< no step along Newton's direction comes closer
    kIterationLimit
  };
  Status status = Status::kIterationLimit;
  RunnerApex apex{};      ///< in the direction of the guess
  double multiplier = 0;  ///< for the apex height at constant energy; stable if its modulus is below one
  bool isStable = false;
  double residual = 0;  ///< |height of the next apex - height|, metres
  int iterations = 0;
  std::string message{};
};

/// The gait near `guess`, with the same energy and direction, by damped Newton steps on the apex map.
/// Throws Error like SpringLeg.
[[nodiscard]] RunningGait findRunningGait(const SpringLeg& leg, const RunnerApex& guess);

}  // namespace rex
