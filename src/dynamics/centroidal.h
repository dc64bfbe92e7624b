#pragma once

#include "kinematics/forward_kinematics.h"

namespace rex {

/// All bodies of a scene taken together, in W.
struct Centroidal {
  Eigen::Vector3d center;           ///< centre of mass, metres
  Eigen::Vector3d velocity;         ///< of the centre of mass, m/s
  Eigen::Vector3d linearMomentum;   ///< kg m/s
  Eigen::Vector3d angularMomentum;  ///< about the centre of mass, kg m^2/s
  Eigen::Matrix3d inertia;          ///< about the centre of mass, of all bodies as if they were one, kg m^2
};

/// `poses` are those of the posture, v are the joint velocities (nv). Only external forces change the
/// momenta. Throws Error naming both sizes if that of v is wrong, and for a scene without mass.
[[nodiscard]] Centroidal centroidal(const Model& model, const BodyPoses& poses, const VectorArg& v);

/// The matrix that maps v to the momenta: 6 x nv, first the rows of the linear momentum, then those of the
/// angular momentum about the centre of mass. Orin, Goswami, Lee 2013, Centroidal dynamics of a humanoid
/// robot. Throws as centroidal.
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> centroidalMomentumMatrix(const Model& model,
                                                                                const BodyPoses& poses);

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
