#pragma once

#include "scene/model.h"

namespace rex::internal {

/// Calls visit(column, freedom, frame) for each degree of freedom between the root and the body; `frame` is
/// the body in whose frame the freedom is given. Joints that mimic one another share a column.
template <class Visit>
void forEachFreedomAbove(const Model& model, BodyId body, const Visit& visit) {
  for (BodyId at = body; at != kWorld; at = model[at].parent) {
    if (model[at].joint == kNoJoint) continue;
    const Joint& joint = model[model[at].joint];
    for (int i = 0; i < joint.nv; ++i) {
      const DegreeOfFreedom& freedom = joint.freedoms[static_cast<std::size_t>(i)];
      const bool inParent = freedom.frame == DegreeOfFreedom::Frame::kParent;
      visit(joint.vIndex + i, freedom, inParent ? joint.parent : at);
    }
  }
}

}  // namespace rex::internal
