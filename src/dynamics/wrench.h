#pragma once

#include <span>

#include "dynamics/workspace.h"

namespace rex {

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

}  // namespace rex
