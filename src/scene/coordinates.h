#pragma once

#include "scene/model.h"

namespace rex {

/// Calls visit(iq, iv, freedom) for each coordinate that is a plain number, at q[iq] with rate v[iv]: all but
/// those of quaternions. Joints that mimic are left out, because their target's coordinate is theirs.
template <class Visit>
void forEachPlainCoordinate(const Model& model, const Visit& visit) {
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    const int plain = joint.nq == joint.nv ? joint.nq : joint.nq - 4;
    for (int i = 0; i < plain; ++i)
      visit(joint.qIndex + i, joint.vIndex + i, joint.freedoms[static_cast<std::size_t>(i)]);
  }
}

/// Calls visit(iq, iv) for each quaternion, with its places in q and v. It comes last in its joint.
template <class Visit>
void forEachQuaternion(const Model& model, const Visit& visit) {
  for (const Joint& joint : model.joints()) {
    if (!joint.mimics && joint.nq != joint.nv)
      visit(joint.qIndex + joint.nq - 4, joint.vIndex + joint.nv - 3);
  }
}

}  // namespace rex
