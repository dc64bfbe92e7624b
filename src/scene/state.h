#pragma once

#include "scene/model.h"

namespace rex {

/// The state of a robot: q (nq), v (nv), time in seconds.
struct State {
  Eigen::VectorXd q, v;
  double time = 0;
};

/// The model's initial posture at rest.
[[nodiscard]] State initialState(const Model& model);

/// q after moving with constant velocity v for one unit of time: q + v, except for quaternions, where v is
/// the angular velocity in the moved frame. Throws Error naming both sizes if q or v has the wrong one.
[[nodiscard]] Eigen::VectorXd integrate(const Model& model, const VectorArg& q, const VectorArg& v);

/// The velocity that leads from q0 to q1 in one unit of time: integrate(model, q0, difference(model, q0, q1))
/// = q1. Throws as integrate.
[[nodiscard]] Eigen::VectorXd difference(const Model& model, const VectorArg& q0, const VectorArg& q1);

}  // namespace rex
