#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/reference.h"
#include "dynamics/inverse_dynamics.h"
#include "physics/physics_world.h"

namespace rex::cli {

/// How joints are held in their posture of the start. Only joints are: nothing drives a free joint, which has
/// no motor, and a joint that mimics moves with its target.
enum class Hold {
  kNone,
  kExact,    ///< computed torque: each joint as a spring of mass one, whatever hangs on it
  kGravity,  ///< springs and dampers, and what the weight of the links asks for while bases stand still
  kPd,       ///< springs and dampers alone: joints sag under weight
  kMotor     ///< position motors of PhysicsWorld, as strong as the joints' efforts
};

/// "free", "held", "held by motors", ...
[[nodiscard]] std::string toString(Hold hold);

/// Whether a free joint carries joints that could be held, as the base of a humanoid does.
[[nodiscard]] bool hasFloatingBase(const Model& model);

/// Holds a posture by forces, at most of kMotor by motors. It copies the model.
class Holder {
 public:
  /// Springs swing with a wave length of 0.1 s and critical damping, for the inertia that each coordinate has
  /// in that posture.
  Holder(const Model& model, Hold hold, const Eigen::VectorXd& q, const Eigen::Vector3d& gravity_W);

  /// The forces (nv), zero on free joints; all zero for kNone and kMotor.
  [[nodiscard]] Eigen::VectorXd forces(const State& state) const;
  /// A motor for each number of v: forces u, or of kMotor those that hold. Joints without a finite, positive
  /// effort are as strong as needed.
  [[nodiscard]] std::vector<Motor> motors(const Eigen::VectorXd& u) const;
  /// Joints that kMotor leaves free, for their coordinates are quaternions.
  [[nodiscard]] std::vector<std::string> unheld() const;

 private:
  [[nodiscard]] Eigen::VectorXd exactForces(const State& state) const;

  Model model_;
  Hold hold_;
  Eigen::Vector3d gravity_W_;
  Reference target_;
  Eigen::VectorXd inertia_;    // of each number of v, for springs
  std::vector<int> undriven_;  // numbers of v that no motor drives
  std::vector<int> carrying_;  // those of them that carry driven joints
};

}  // namespace rex::cli
