#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "dynamics/requirements_internal.h"
#include "geometry/rotation.h"

namespace rex::internal {

void requirePositions(const Model& model, const VectorArg& q) {
  requireSize("joint positions q", q.size(), model.nq());
  if (model.nq() == model.nv()) return;  // there are no quaternions
  for (const Link& link : model.links()) {
    if (link.kind == Link::Kind::kQuaternion)
      static_cast<void>(rotationFromQuaternion(q.segment<4>(link.qIndex)));
  }
}

void requireVelocities(const Model& model, const VectorArg& v) {
  requireSize("joint velocities v", v.size(), model.nv());
}

bool hasMimics(const Model& model) {
  return std::ranges::any_of(model.joints(), [](const Joint& joint) { return joint.mimics; });
}

void throwSingular(const Model& model, const Link& link) {
  const Body& body = model[BodyId{link.body}];
  const std::string& joint = model[body.joint].name;
  if (body.mass > 0) {
    throw Error({.what = fmt::format("joint '{}' moves no inertia", joint),
                 .wanted = fmt::format("some about its axis: give body '{}' an inertia", body.name)});
  }
  throw Error({.what = fmt::format("joint '{}' moves no mass", joint),
               .wanted = fmt::format("some: give body '{}' a mass", body.name)});
}

}  // namespace rex::internal
