#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/reference.h"
#include "dynamics/inverse_dynamics.h"
#include "physics/physics_world.h"

namespace rex {

/// How joints are held in their initial posture. A free joint is not held, because it has no motor, and a
/// mimic joint moves with its target.
enum class Hold {
  kNone,
  kExact,    ///< computed torque: each joint is a spring with unit mass, whatever its load
  kGravity,  ///< springs and dampers with gravity compensation for resting bases
  kPd,       ///< springs and dampers alone: joints sag under gravity
  kMotor     ///< position motors of PhysicsWorld, limited by the joints' efforts
};

/// "free", "held", "held by motors", ...
[[nodiscard]] std::string toString(Hold hold);

/// Whether a free joint carries joints that could be held, like the base of a humanoid.
[[nodiscard]] bool hasFloatingBase(const Model& model);

/// Holds a posture with forces, or with motors for kMotor. Copies the model.
class Holder {
 public:
  /// Springs have a wave length of 0.1 s and critical damping, for the inertia of each coordinate in that
  /// posture.
  Holder(const Model& model, Hold hold, const Eigen::VectorXd& q, const Eigen::Vector3d& gravity_W);

  /// The forces (nv), zero on free joints; all zero for kNone and kMotor.
  [[nodiscard]] Eigen::VectorXd forces(const State& state) const;
  /// One motor per entry of v: forces u or, for kMotor, motors that hold the posture. Joints without a
  /// finite, positive effort are unlimited.
  [[nodiscard]] std::vector<Motor> motors(const Eigen::VectorXd& u) const;
  /// Joints that kMotor leaves free because their coordinates are quaternions.
  [[nodiscard]] std::vector<std::string> unheld() const;

 private:
  [[nodiscard]] Eigen::VectorXd exactForces(const State& state) const;

  Model model_;
  Hold hold_;
  Eigen::Vector3d gravity_W_;
  Reference target_;
  Eigen::VectorXd inertia_;    // of each entry of v, for springs
  std::vector<int> undriven_;  // indices into v that no motor drives
  std::vector<int> carrying_;  // those of them that carry driven joints
};

}  // namespace rex
