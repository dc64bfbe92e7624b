#pragma once

#include <span>
#include <string>

#include "dynamics/inverse_dynamics.h"
#include "locomotion/support_polygon.h"

namespace rex {

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
