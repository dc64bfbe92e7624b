#pragma once

#include <Eigen/Core>

#include "kinematics/forward_kinematics.h"
#include "scene/model.h"

namespace rex {

// The springs of joints (JointSpec::stiffness, springReference). They are forces on joints beside u, like
// friction: inverse and forward dynamics know nothing of them, but Stepper and PhysicsWorld apply them, and
// energy() counts them.
//
//   const Eigen::VectorXd a = forwardDynamics(model, q, v, u + springForces(model, q));

/// How far the spring of a joint is from its rest, for each entry of its v.
using SpringStretch = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 6, 1>;

/// The stretch at coordinates of the joint's own (nq; those of a joint that mimics, not of its target): their
/// distance from springReference, and of a quaternion the turn from there as a rotation vector in the moved
/// frame. Throws Error for a quaternion that is zero or not finite.
[[nodiscard]] SpringStretch springStretch(const Joint& joint, const VectorArg& q);

/// The forces (nv) of all springs: -stiffness * stretch; of joints that mimic, times the ratio. Throws Error
/// naming both sizes if q has the wrong one, and as springStretch.
[[nodiscard]] Eigen::VectorXd springForces(const Model& model, const VectorArg& q);
/// Overload for hot loops: adds them to u (nv).
void addSpringForces(const Model& model, const VectorArg& q, Eigen::Ref<Eigen::VectorXd> u);

/// Their energy in joules, stiffness * |stretch|^2 / 2 each. Throws as springForces.
[[nodiscard]] double springEnergy(const Model& model, const VectorArg& q);

}  // namespace rex
