#pragma once

#include <span>
#include <vector>

#include "geometry/pose.h"
#include "kinematics/forward_kinematics.h"
#include "kinematics/task_maps.h"
#include "scene/model.h"
#include "scene/state.h"

namespace rex {

/// Memory for the functions of this module, owned by the caller of a hot loop: they allocate nothing once
/// it has been used with a model.
struct DynamicsWorkspace {
  /// As many numbers as a kernel processes at once, suitably aligned.
  struct alignas(64) Line {
    double numbers[8];
  };
  std::vector<Line> lines{};
  /// M and F, for models in which joints mimic others.
  Eigen::MatrixXd M{};
  Eigen::VectorXd F{};
  /// Used for a velocity or an acceleration of zero.
  Eigen::VectorXd zeros{};
  /// The poses of bodies, and a twist or a force of each.
  BodyPoses poses{};
  std::vector<Vector6d> perBody{};
};

/// An external wrench at the point Q of body B, in W: force (N) and torque (N m).
struct Wrench {
  BodyId body = kWorld;
  Eigen::Vector3d p_BQ{0, 0, 0};
  Eigen::Vector3d force_W{0, 0, 0};
  Eigen::Vector3d torque_W{0, 0, 0};
};

/// The joint forces (nv) caused by wrenches, to be added to u: the sum of J_Q^T force + J_w^T torque.
[[nodiscard]] Eigen::VectorXd wrenchForces(const Model& model, const BodyPoses& poses,
                                           std::span<const Wrench> wrenches);
/// Overload for hot loops. The caller owns u, which must be nv already; otherwise throws Error naming both
/// sizes. The poses may be those of the workspace.
void wrenchForces(const Model& model, const BodyPoses& poses, std::span<const Wrench> wrenches,
                  DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> u);

/// Throws Error for a body that the model does not have, and naming the body for numbers that are not finite.
void requireValid(const Model& model, std::span<const Wrench> wrenches);

// The equation of motion is M(q) a + F(q, v) = u (slide 3:28), with q (nq), and v, its derivative a and the
// joint forces u (nv each; N m or N). Gravity is an acceleration in W, m/s^2. All functions throw Error
// naming both sizes for a vector of the wrong size, and for quaternions that are zero or not finite.

/// (0, 0, -9.81) m/s^2.
inline Eigen::Vector3d earthGravity() { return {0, 0, -9.81}; }

/// The forces u that accelerate the joints by a: u = M(q) a + F(q, v), by the recursive Newton-Euler
/// algorithm. Slide 3:23; Featherstone, Rigid Body Dynamics Algorithms, table 5.1.
[[nodiscard]] Eigen::VectorXd inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v,
                                              const VectorArg& a,
                                              const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns u, which must be nv already and may be a or v.
void inverseDynamics(const Model& model, const VectorArg& q, const VectorArg& v, const VectorArg& a,
                     const Eigen::Vector3d& gravity_W, DynamicsWorkspace& workspace,
                     Eigen::Ref<Eigen::VectorXd> u);

/// F(q, v), the Coriolis, centrifugal and gravity terms: the forces u at which v stays constant. Slide 3:24.
[[nodiscard]] Eigen::VectorXd biasForces(const Model& model, const VectorArg& q, const VectorArg& v,
                                         const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns F, which must be nv already and may be v.
void biasForces(const Model& model, const VectorArg& q, const VectorArg& v, const Eigen::Vector3d& gravity_W,
                DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> F);

/// G(q), the joint forces that hold the robot still: the gradient of its potential energy. Slide 3:24.
[[nodiscard]] Eigen::VectorXd gravityForces(const Model& model, const VectorArg& q,
                                            const Eigen::Vector3d& gravity_W = earthGravity());
/// Overload for hot loops. The caller owns G, which must be nv already.
void gravityForces(const Model& model, const VectorArg& q, const Eigen::Vector3d& gravity_W,
                   DynamicsWorkspace& workspace, Eigen::Ref<Eigen::VectorXd> G);

/// J' v (d): the acceleration of a map's value when the joints do not accelerate. Computed from differences
/// of J v along v, which works for every map and is accurate to about 1e-10 |v|^2 for lengths of metres,
/// except at a jump or kink of the map. Throws Error for wrong sizes and numbers that are not finite.
[[nodiscard]] Eigen::VectorXd velocityAcceleration(const Model& model, const State& state,
                                                   const TaskMap& map);

}  // namespace rex
