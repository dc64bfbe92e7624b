#pragma once

#include "control/pid.h"
#include "dynamics/inverse_dynamics.h"
#include "kinematics/motion_profile.h"
#include "scene/state.h"

namespace rex {

// All functions allocate their results. They throw Error for vectors of the wrong size and numbers that are
// not finite, saying which, and for what is named below.

/// The desired configuration, velocity and acceleration at one moment: q (nq), v and a (nv).
struct Reference {
  Eigen::VectorXd q, v, a;
};

/// Standing still at q.
[[nodiscard]] Reference standAt(const Model& model, const VectorArg& q);

/// The reference at time t on the straight path from posture q0 to qT. The motion takes `seconds` from time
/// 0 and rests before and after. Throws Error like profileAt, and unless seconds > 0.
[[nodiscard]] Reference referenceAlong(const Model& model, const VectorArg& q0, const VectorArg& qT,
                                       double seconds, double t, const MotionProfile& profile = {});

/// The reference at sample i of the postures in the columns of Q (nq x N), tau seconds apart: velocity and
/// acceleration by central differences (slide 3:30), at the first and last sample by one-sided ones, all
/// exact to O(tau^2) for N >= 4; fewer samples are taken for a parabola, a line, or standing still. Throws
/// Error if Q has no columns or i is not one of them, and unless tau > 0.
[[nodiscard]] Reference referenceAt(const Model& model, const MatrixArg& Q, double tau, int i);

/// The acceleration (nv) that makes each joint behave like a unit point mass on a spring to the reference:
/// a* = a_ref + Kp (q_ref - q) + Kd (v_ref - v). Slide 3:30; for quaternions, q_ref - q is difference().
/// Choose gains with pdGains(1, lambda, xi); negative gains, which push away, are accepted.
[[nodiscard]] Eigen::VectorXd followReference(const Model& model, const State& state,
                                              const Reference& reference, const PdGains& gains);

/// The forces u (nv) with which every joint follows the reference like a unit point mass on a spring: u = M
/// a* + F with the a* of followReference, computed by inverse dynamics without forming M. Slides 3:29 and
/// 3:30. Allocates. Throws Error like followReference and inverseDynamics, and for a gravity that is not
/// finite.
[[nodiscard]] Eigen::VectorXd computedTorque(const Model& model, const State& state,
                                             const Reference& reference, const PdGains& gains,
                                             const Eigen::Vector3d& gravity_W = earthGravity());

}  // namespace rex
