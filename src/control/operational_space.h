#pragma once

#include <span>

#include "control/pid.h"
#include "dynamics/inverse_dynamics.h"
#include "kinematics/task_maps.h"

namespace rex {

// Torque control in task space. The value y of a task accelerates with y'' = J a + J' v, so forces u cause
// y'' = T (u - F) + J' v with T = J M^-1: slide 3:33 without its factor 2. These functions allocate.

/// A task, its reference motion, and the gains to follow it: y''* = y''_ref + Kp (y_ref - y) + Kd (y'_ref -
/// y'), like a unit point mass on a spring (slide 3:34). y_ref is task.target.
struct OperationalTask {
  Task task{};
  PdGains gains{};                 ///< as given by pdGains(1, lambda, xi)
  Eigen::VectorXd velocity{};      ///< y'_ref, d; empty: zero
  Eigen::VectorXd acceleration{};  ///< y''_ref, d; empty: zero
};

/// y''* of a task whose value and Jacobian are given, d. Throws Error for a target or a reference of the
/// wrong size, and for numbers that are not finite.
[[nodiscard]] Eigen::VectorXd wantedAcceleration(const OperationalTask& task, const TaskValue& value,
                                                 const State& state);

struct OperationalSpaceOptions {
  Eigen::MatrixXd H{};   ///< nv x nv, symmetric and positive definite: the metric of forces; empty: Id
  Eigen::VectorXd u0{};  ///< nv: preferred forces, used where the tasks leave freedom; empty: zero
  Eigen::Vector3d gravity_W = earthGravity();
  /// For prioritisedForces(), as in hierarchicalStep: directions in which a unit of u changes y'' by less
  /// than this are damped.
  double damping = 1e-3;
};

/// The forces u (nv) that minimise the sum of rho_i |y_i'' - y_i''*|^2 over all tasks, with precisions
/// rho_i, plus |u - u0|_H^2: u = T# (y''* - J' v + T F) + (Id - T# T) u0, T# = (T^T C T + H)^-1 T^T C.
/// Slides 3:33 and 3:35. Throws Error like stackTasks and inverseKinematicsStep, for a velocity or
/// acceleration of the wrong size, numbers that are not finite, and, like forwardDynamics, for a singular
/// mass matrix.
[[nodiscard]] Eigen::VectorXd operationalSpaceForces(const Model& model, const State& state,
                                                     std::span<const OperationalTask> tasks,
                                                     const OperationalSpaceOptions& options = {});

/// The same in the limit C -> infinity with strict priorities: the first task is fulfilled, T# = H^-1 T^T
/// (T H^-1 T^T)^-1, the second as well as possible without changing y_1'', and so on; the remaining freedom
/// brings u close to u0 in H. With H = M^-1 these are the forces of Khatib (IEEE J. Robotics and
/// Automation, 1987). Throws Error as above and like hierarchicalStep.
[[nodiscard]] Eigen::VectorXd prioritisedForces(const Model& model, const State& state,
                                                std::span<const OperationalTask> tasks,
                                                const OperationalSpaceOptions& options = {});

}  // namespace rex
