#pragma once

#include "control/pd_gains.h"
#include "kinematics/motion_profile.h"
#include "scene/state.h"

namespace rex {

// All functions allocate what they return. They throw Error for vectors of the wrong size and numbers that
// are not finite, saying which, and as named below.

/// Where a robot shall be at one moment, how fast, and how that changes: q (nq), v and a (nv).
struct Reference {
  Eigen::VectorXd q, v, a;
};

/// To stand still at q.
[[nodiscard]] Reference standAt(const Model& model, const VectorArg& q);

/// On the straight way from posture q0 to qT, which takes `seconds` from time 0 and rests before and after:
/// at time t. Throws Error as profileAt, and unless seconds > 0.
[[nodiscard]] Reference referenceAlong(const Model& model, const VectorArg& q0, const VectorArg& qT,
                                       double seconds, double t, const MotionProfile& profile = {});

/// At sample i of the postures in the columns of Q (nq x N), tau seconds apart, as if they stood still
/// before and after. Acceleration by the differences of slide 3:30, velocity by the mean of the two, both
/// exact to O(tau^2). Throws Error for no columns, an i that is none of them, and unless tau > 0.
[[nodiscard]] Reference referenceAt(const Model& model, const MatrixArg& Q, double tau, int i);

/// The acceleration (nv) that makes each joint behave like a point of mass one on a spring to the reference:
/// a* = a_ref + Kp (q_ref - q) + Kd (v_ref - v). Slide 3:30; at quaternions, q_ref - q is difference(). Gains
/// are those of pdGains(1, lambda, xi); negative ones, which push away, are taken as they are.
[[nodiscard]] Eigen::VectorXd followReference(const Model& model, const State& state,
                                              const Reference& reference, const PdGains& gains);

}  // namespace rex
