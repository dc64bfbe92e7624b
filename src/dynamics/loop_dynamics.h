#pragma once

#include <span>

#include "dynamics/inverse_dynamics.h"
#include "kinematics/task_maps.h"
#include "scene/state.h"

namespace rex {

struct LoopDynamicsOptions {
  /// 1/s: errors of the loops decay like critically damped springs of this rate (Baumgarte 1972); 0: no
  /// correction; use it for closed states.
  double stabilisation = 0;
  Eigen::Vector3d gravity_W = earthGravity();
};

/// How a mechanism with closed loops accelerates.
struct LoopMotion {
  Eigen::VectorXd a{};       ///< nv
  Eigen::VectorXd forces{};  ///< lambda, one per row of the maps: newtons for rows in metres
};

/// Solves M a + F = u + J^T lambda and J a = -J' v for a tree of joints whose `loops` (closed_loops.h) stay
/// closed: slide 3:28 with constraints; Featherstone, chapter 8. Where rows depend on each other lambda is
/// the shortest. Throws Error like forwardDynamics() and velocityAcceleration(), and for a negative
/// stabilisation.
[[nodiscard]] LoopMotion loopDynamics(const Model& model, const State& state, std::span<const TaskMap> loops,
                                      const VectorArg& u, const LoopDynamicsOptions& options = {});

/// What joint forces change: loopDynamics() is affine in them, a(u) = a(0) + a_u u and forces(u) = forces(0)
/// + forces_u u.
struct LoopResponse {
  Eigen::MatrixXd a_u{};       ///< nv x nv: what the loops leave of M^-1
  Eigen::MatrixXd forces_u{};  ///< rows x nv
};

/// For a mass matrix that is positive definite: loopDynamics() throws for others. Throws Error for a q of the
/// wrong size.
[[nodiscard]] LoopResponse loopResponse(const Model& model, const VectorArg& q,
                                        std::span<const TaskMap> loops);

/// The closed state near one that a step of integration has left: q by assemble(), v with the least change
/// of kinetic energy. Throws Error if the loops cannot be closed.
[[nodiscard]] State closedState(const Model& model, const State& state, std::span<const TaskMap> loops);

}  // namespace rex
