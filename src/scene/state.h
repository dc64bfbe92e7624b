#pragma once

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

#include "scene/model.h"

namespace rex {

/// Calls visit(iq, iv, freedom) for each scalar coordinate q[iq] with rate v[iv], that is, for all but the
/// entries of quaternions. Mimic joints are skipped, because they share the coordinate of their target.
template <class Visit>
void forEachPlainCoordinate(const Model& model, const Visit& visit) {
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    const int plain = joint.nq == joint.nv ? joint.nq : joint.nq - 4;
    for (int i = 0; i < plain; ++i)
      visit(joint.qIndex + i, joint.vIndex + i, joint.freedoms[static_cast<std::size_t>(i)]);
  }
}

/// Calls visit(iq, iv) for each quaternion, with its indices in q and v. It comes last in its joint.
template <class Visit>
void forEachQuaternion(const Model& model, const Visit& visit) {
  for (const Joint& joint : model.joints()) {
    if (!joint.mimics && joint.nq != joint.nv)
      visit(joint.qIndex + joint.nq - 4, joint.vIndex + joint.nv - 3);
  }
}

/// The joint that q[i] or v[i] belongs to, 0 <= i < nq or nv; never a joint that mimics it.
[[nodiscard]] inline const Joint& jointOfPosition(const Model& model, Eigen::Index i) {
  const auto found = std::find_if(model.joints().begin(), model.joints().end(), [&](const Joint& joint) {
    return !joint.mimics && joint.qIndex <= i && i < joint.qIndex + joint.nq;
  });
  assert(found != model.joints().end());
  return *found;
}
[[nodiscard]] inline const Joint& jointOfVelocity(const Model& model, Eigen::Index i) {
  const auto found = std::find_if(model.joints().begin(), model.joints().end(), [&](const Joint& joint) {
    return !joint.mimics && joint.vIndex <= i && i < joint.vIndex + joint.nv;
  });
  assert(found != model.joints().end());
  return *found;
}

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

/// The name of each entry of q (nq) or v (nv): its joint's, "elbow", or "base [1]" if the joint has
/// several.
[[nodiscard]] std::vector<std::string> positionNames(const Model& model);
[[nodiscard]] std::vector<std::string> velocityNames(const Model& model);

}  // namespace rex
