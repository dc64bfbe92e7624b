#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/computed_torque.h"
#include "dynamics/inverse_dynamics.h"
#include "physics/physics_world.h"

namespace rex {

/// How joints are held in their initial posture. A free joint is not held, because it has no motor, and a
/// mimic joint moves with its target.
enum class Hold {
  kNone,
  kExact,    ///< computed torque: each joint is a spring with unit mass, whatever its load
  kGravity,  ///< springs and dampers with gravity compensation for resting bases, limited by the efforts
  kPd,       ///< springs and dampers alone, limited by the joints' efforts: joints sag under gravity
  kMotor     ///< position motors of PhysicsWorld, limited by the joints' efforts
};

/// The wave length of a joint that is held by forces, in seconds; it is critically damped.
constexpr double kHoldWave = 0.1;

/// "free", "held", "held by motors", ...
[[nodiscard]] std::string toString(Hold hold);

/// Whether a free joint carries joints that could be held, like the base of a humanoid.
[[nodiscard]] bool hasFloatingBase(const Model& model);

/// Holds a posture with forces, or with motors for kMotor. Copies the model.
///
/// Springs and dampers act on the position and the velocity at the end of a step, predicted without contacts
/// and pins: "stable proportional-derivative controllers", Tan, Liu and Turk 2011. They take at most the
/// momentum that is there, and contacts and pins only leave them less to move, so that they are stable at any
/// step and mass, also for joints about nearly the same axis, which feel much less mass than they carry.
class Holder {
 public:
  /// For steps of `tau` seconds. Springs suit the inertia M_ii that each coordinate carries in that posture.
  /// Throws Error as forwardDynamics, for joints that move no mass.
  Holder(const Model& model, Hold hold, const Eigen::VectorXd& q, const Eigen::Vector3d& gravity_W,
         double tau);

  /// The forces (nv) during the next step, zero on free joints; all zero for kNone and kMotor.
  [[nodiscard]] Eigen::VectorXd forces(const State& state) const;
  /// One motor per entry of v: forces u or, for kMotor, motors that hold the posture. Joints without a
  /// finite, positive effort are unlimited.
  [[nodiscard]] std::vector<Motor> motors(const Eigen::VectorXd& u) const;
  /// Joints that kMotor leaves free because their coordinates are quaternions.
  [[nodiscard]] std::vector<std::string> unheld() const;

 private:
  [[nodiscard]] Eigen::VectorXd exactForces(const State& state) const;
  [[nodiscard]] Eigen::VectorXd springForces(const State& state) const;

  Model model_;
  Hold hold_;
  Eigen::Vector3d gravity_W_;
  double tau_;
  Reference target_;
  Eigen::VectorXd Kp_, Kd_;    // of springs and dampers on each entry of v
  Eigen::VectorXd efforts_;    // the largest force on each entry of v
  std::vector<int> undriven_;  // indices into v that no motor drives
  std::vector<int> carrying_;  // those of them that carry driven joints
};

}  // namespace rex
