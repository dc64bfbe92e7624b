#pragma once

#include <span>

#include "kinematics/forward_kinematics.h"

namespace rex {

/// A push from outside on the point Q of body B, in W: force (N) and torque (N m).
struct Wrench {
  BodyId body = kWorld;
  Eigen::Vector3d p_BQ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d torque_W = Eigen::Vector3d::Zero();
};

/// What wrenches do at the joints (nv), to be added to u: the sum of J_Q^T force + J_w^T torque.
[[nodiscard]] Eigen::VectorXd wrenchForces(const Model& model, const BodyPoses& poses,
                                           std::span<const Wrench> wrenches);

}  // namespace rex
