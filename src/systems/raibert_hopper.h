#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "systems/spring_leg.h"

namespace rex {

/// A body that hops in the plane on one springy leg without mass, whose hip is its centre of mass: slide
/// 11:4; Raibert, Dynamically stable legged locomotion, 1985. Angles are counterclockwise.
struct RaibertHopper {
  double mass = 10;         ///< kg
  double inertia = 2;       ///< kg m^2, about the centre of mass
  double stiffness = 4000;  ///< N/m
  double damping = 40;      ///< N s/m, along the leg
  double restLength = 1;    ///< metres
  double g = 9.81;          ///< m/s^2
};

/// Its three controllers. None knows the dynamics: where the leg damps, the speed stays a little behind.
struct RaibertGains {
  double height = 0.06;     ///< m of thrust more for each m that the last apex was too low
  double placement = 0.06;  ///< s: m that the foot goes farther for each m/s too fast
  double attitude = 15;     ///< N m/rad of the hip's torque on the body in stance
  double rate = 10;         ///< N m s/rad
};

/// What it shall do, at its next apexes.
struct HopperCommand {
  double height = 1.3;  ///< metres
  double speed = 0;     ///< m/s forward
};

/// The hopper at the highest point of its flight, and what its controllers remember.
struct HopperApex {
  double x = 0, height = 1.3;  ///< metres
  double speed = 0;            ///< m/s forward
  double pitch = 0, rate = 0;  ///< rad and rad/s, of the body
  double thrust = 0.05;        ///< metres: by how much the leg gets longer at the bottom of the next stance
  double stanceTime = 0.16;    ///< seconds that the last stance took
};

/// One hop, and how it ended: as a runner's.
struct HopperHop {
  HopStatus status = HopStatus::kTimeLimit;
  HopperApex apex{};  ///< the next one, if kHopped
  double time = 0;    ///< seconds from apex to apex, or until the end
  double foot = 0;    ///< where it touched down, x in metres
  double legAngle =
      0;  ///< of the leg from the vertical at touchdown, radians; positive: the foot is in front
  /// (x from the foot, y, pitch, their rates) at touchdown, where the leg is shortest, and at takeoff; where
  /// it ended earlier, that.
  Eigen::Matrix<double, 6, 3> stance = Eigen::Matrix<double, 6, 3>::Zero();
  std::string message{};  ///< for example "fell after 0.4 s"
};

/// Simulates from apex to apex. In flight the foot is set at speed * stanceTime / 2 + placement gain * (speed
/// - wanted) before the hip; in stance the hip turns the body upright; at the bottom the leg thrusts, more
/// than in the last hop where that was too low. The foot does not slip. Throws Error for constants, a stance
/// time or a wanted height that are not positive, negative gains or damping, and numbers that are not finite.
[[nodiscard]] HopperHop hop(const RaibertHopper& hopper, const RaibertGains& gains,
                            const HopperCommand& command, const HopperApex& apex);

/// The hopper at one time of a hop, in the world: metres, radians.
struct HopperSample {
  double time = 0;  ///< seconds since the apex
  Eigen::Vector2d hip{0, 0}, foot{0, 0};
  double pitch = 0;
};

/// A hop in samples, `count` for each of its phases (down, shorter, longer, up), as far as it goes: to draw
/// it. In flight the leg swings evenly to the vertical, and on to its next place. Throws Error like hop(),
/// and for a count below 2.
[[nodiscard]] std::vector<HopperSample> hopSamples(const RaibertHopper& hopper, const RaibertGains& gains,
                                                   const HopperCommand& command, const HopperApex& apex,
                                                   int count);

}  // namespace rex
