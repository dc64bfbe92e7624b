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
  const int quaternions = model.nq() - model.nv();
  const int linksOfTheirOwn = model.nv() - 2 * quaternions;  // a quaternion's link has three velocities
  return static_cast<int>(model.links().size()) > linksOfTheirOwn;
}

const Joint& jointOfLink(const Model& model, int link) {
  return model[model[BodyId{model.links()[static_cast<std::size_t>(link)].body}].joint];
}

void throwSingular(const Model& model, const Joint& joint) {
  const Body& body = model[joint.child];
  if (body.mass > 0) {
    throw Error({.what = fmt::format("joint '{}' moves no inertia", joint.name),
                 .wanted = fmt::format("some about its axis: give body '{}' an inertia", body.name)});
  }
  throw Error({.what = fmt::format("joint '{}' moves no mass", joint.name),
               .wanted = fmt::format("some: give body '{}' a mass", body.name)});
}

}  // namespace rex::internal
