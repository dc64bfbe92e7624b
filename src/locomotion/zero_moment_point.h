#pragma once

#include <span>
#include <string>

#include <Eigen/Core>

#include "dynamics/inverse_dynamics.h"
#include "locomotion/footsteps.h"

namespace rex {

/// Position and velocity of a centre of mass seen from above: x and y in W, metres and m/s.
struct CenterMotion {
  Eigen::Vector2d c{0, 0}, v{0, 0};
};

/// The linear inverted pendulum: a centre of mass at constant height above level ground, without angular
/// momentum about it, so c'' = omega^2 (c - p) for the zero moment point p (slide 11:12; Kajita et al.
/// 2001, The 3D linear inverted pendulum mode). Both axes behave alike and independently. All functions
/// throw Error for a height or g that is not positive, and for numbers that are not finite.
struct InvertedPendulum {
  double height = 0.8;  ///< of the centre of mass above the ground, metres
  double g = 9.81;      ///< m/s^2

  /// sqrt(g / height), 1/s.
  [[nodiscard]] double omega() const;
  /// c'', m/s^2, for the zero moment point p (x and y in W, metres).
  [[nodiscard]] Eigen::Vector2d acceleration(const Eigen::Vector2d& c, const Eigen::Vector2d& p) const;
  /// p for an acceleration: the inverse of the above.
  [[nodiscard]] Eigen::Vector2d zmp(const Eigen::Vector2d& c, const Eigen::Vector2d& acceleration) const;
  /// The motion t seconds later with constant p, in closed form. t may be negative.
  [[nodiscard]] CenterMotion after(const CenterMotion& start, const Eigen::Vector2d& p, double t) const;
  /// c + v / omega: the only constant p that brings the motion to rest, above that p. Pratt et al. 2006,
  /// Capture point.
  [[nodiscard]] Eigen::Vector2d capturePoint(const CenterMotion& at) const;
  /// v^2 / 2 - omega^2 (c - p)^2 / 2 for each axis, J/kg: constant while p is. If negative, the motion
  /// turns back before it passes p.
  [[nodiscard]] Eigen::Vector2d orbitalEnergy(const CenterMotion& at, const Eigen::Vector2d& p) const;
};

/// The point on the ground about which the ground reaction has no horizontal moment. Slide 11:10, with
/// erratum 22: f_i = m_i (p_i'' - g). Popovic, Goswami, Herr 2005, Ground reference points in legged
/// locomotion.
struct ZeroMomentPoint {
  bool exists = false;  ///< false if the ground does not push: nothing touches it, or it would have to pull
  Eigen::Vector3d p_W{0, 0, 0};      ///< metres, on the ground; if it exists
  Eigen::Vector3d force_W{0, 0, 0};  ///< force of the ground on the robot, N
  double moment = 0;                 ///< moment of the ground about the vertical through p_W, N m
  std::string message{};             ///< why it does not exist
};

/// The zero moment point for a robot at q (nq) that moves with v and a (nv each) and touches only level
/// ground at z = groundHeight (metres). Throws Error like inverseDynamics(), for a scene without mass, and
/// for numbers that are not finite.
[[nodiscard]] ZeroMomentPoint zmpOfMotion(const Model& model, const VectorArg& q, const VectorArg& v,
                                          const VectorArg& a, double groundHeight = 0,
                                          const Eigen::Vector3d& gravity_W = earthGravity());

/// A force of the ground on the robot (N) at a point (metres), in W.
struct ContactForce {
  Eigen::Vector3d p_WC{0, 0, 0};
  Eigen::Vector3d force_W{0, 0, 0};
};

/// The same from measured contact forces; on level ground it is the centre of pressure. Contacts may lie
/// above or below groundHeight, as on stairs. Throws Error for numbers that are not finite.
[[nodiscard]] ZeroMomentPoint zmpOfContacts(std::span<const ContactForce> contacts, double groundHeight = 0);

/// Whether a robot at rest at q is statically stable: the margin of its centre of mass, seen from above
/// (slide 11:7). Throws Error like forwardKinematics() and supportMargin(), and for a scene without mass.
[[nodiscard]] SupportMargin staticStability(const Model& model, const VectorArg& q,
                                            const SupportPolygon& support, double wantedMargin = 0);

}  // namespace rex
