#pragma once

#include "systems/motion_model.h"

namespace rex {

/// A quadrotor seen from the side, with two rotors: x = (x, z, pitch, vx, vz, pitch rate), z up and the pitch
/// positive from x towards z; u = (left, right), the thrusts in newtons; the right one, on the side
/// of x, raises the pitch. Sabatino 2015; Tedrake, Underactuated robotics, ch. 3.
struct PlanarQuadrotor {
  double mass = 0.5, inertia = 0.005;  ///< kg, kg m^2 about the centre of mass
  double arm = 0.15;                   ///< metres from the centre of mass to a rotor
  double gravity = 9.81;
  /// Deviations of gusts: white noise of the accelerations, m/s^2 and rad/s^2 times the root of a second.
  double gust = 0.05, tumble = 0.05;
};

/// Its motion with constant thrusts: pitch and rate exactly, the rest by integrals that are accurate to
/// rounding. Throws Error for a mass, inertia or arm that is not positive, and negative noise.
[[nodiscard]] MotionModel motionModel(const PlanarQuadrotor& quadrotor);

/// The thrusts that keep it hovering level: half of its weight each, N.
[[nodiscard]] Eigen::Vector2d hoverThrusts(const PlanarQuadrotor& quadrotor);

/// Kinetic and potential energy of a state, joules; zero at rest at z = 0.
[[nodiscard]] double totalEnergy(const PlanarQuadrotor& quadrotor, const VectorArg& x);

}  // namespace rex
