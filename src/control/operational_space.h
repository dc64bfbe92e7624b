#pragma once

#include <span>

#include "control/pd_gains.h"
#include "dynamics/inverse_dynamics.h"
#include "kinematics/task.h"
#include "scene/state.h"

namespace rex {

// Torque control of what a robot shall do in the world. The value y of a task accelerates by y'' = J a +
// J' v, so that forces u bring about y'' = T (u - F) + J' v with T = J M^-1: slide 3:33 without its factor 2.
// These functions allocate.

/// A task, its motion, and how stiffly its value follows that: y''* = y''_ref + Kp (y_ref - y) + Kd (y'_ref -
/// y'), as a point of mass one on a spring (slide 3:34). y_ref is task.target.
struct OperationalTask {
  Task task{};
  PdGains gains{};                 ///< those of pdGains(1, lambda, xi)
  Eigen::VectorXd velocity{};      ///< y'_ref, d; empty: zero
  Eigen::VectorXd acceleration{};  ///< y''_ref, d; empty: zero
};

struct OperationalSpaceOptions {
  Eigen::MatrixXd H{};   ///< nv x nv, symmetric and positive definite: the price of forces; empty: Id
  Eigen::VectorXd u0{};  ///< nv: the forces wished for where tasks leave a choice; empty: zero
  Eigen::Vector3d gravity_W = earthGravity();
  /// Of prioritisedForces(), as in hierarchicalStep: directions that forces move by less than this, in y''
  /// per unit of u, are pushed less.
  double damping = 1e-3;
};

/// J' v (d): how the value of a map accelerates where the joints do not. By differences of J v along v, which
/// suit every map: exact to about 1e-10 |v|^2 for lengths of metres, but not at a jump or corner of the map.
/// Throws Error for wrong sizes and numbers that are not finite.
[[nodiscard]] Eigen::VectorXd velocityAcceleration(const Model& model, const State& state,
                                                   const TaskMap& map);

/// The forces u (nv) that minimise the sum of rho_i |y_i'' - y_i''*|^2 over all tasks, rho_i being their
/// precision, plus |u - u0|_H^2: u = T# (y''* - J' v + T F) + (Id - T# T) u0, T# = (T^T C T + H)^-1 T^T C.
/// Slides 3:33 and 3:35. Throws Error as stackTasks and inverseKinematicsStep, for a velocity or acceleration
/// of another size, numbers that are not finite, and a mass matrix that is singular, as forwardDynamics.
[[nodiscard]] Eigen::VectorXd operationalSpaceForces(const Model& model, const State& state,
                                                     std::span<const OperationalTask> tasks,
                                                     const OperationalSpaceOptions& options = {});

/// The same in the limit C -> infinity with strict priorities: the first task is fulfilled, T# = H^-1 T^T (T
/// H^-1 T^T)^-1, the second as well as that allows without changing y_1'', and so on; then u is next to u0 in
/// H. With H = M^-1 these are the forces of Khatib (IEEE J. Robotics and Automation, 1987). Throws Error as
/// above and as hierarchicalStep.
[[nodiscard]] Eigen::VectorXd prioritisedForces(const Model& model, const State& state,
                                                std::span<const OperationalTask> tasks,
                                                const OperationalSpaceOptions& options = {});

}  // namespace rex
