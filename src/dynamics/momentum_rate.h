#pragma once

#include "kinematics/forward_kinematics.h"

namespace rex {

/// The rate of change of the momenta of a scene, in W: the effect of all external forces, including gravity.
struct MomentumRate {
  Eigen::Vector3d force;   ///< d/dt of the linear momentum, N
  Eigen::Vector3d torque;  ///< d/dt of the angular momentum about the origin of W, N m
};

/// `poses` are those of the posture, v and a the joint velocities and their derivatives (nv each). These
/// are the inertial terms of slide 11:10: the sum of p_i x m_i a_i + I_i w_i' + w_i x I_i w_i over all
/// bodies. Throws Error naming both sizes if that of v or a is wrong.
[[nodiscard]] MomentumRate momentumRate(const Model& model, const BodyPoses& poses, const VectorArg& v,
                                        const VectorArg& a);

}  // namespace rex
