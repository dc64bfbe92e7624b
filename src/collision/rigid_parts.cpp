#include "collision/reference_posture_internal.h"
#include "collision/rigid_parts_internal.h"

namespace rex::internal {
namespace {

constexpr double kSamePlace = 1e-9;  // metres: origins of joints that count as one

std::size_t placeOf(BodyId body) { return static_cast<std::size_t>(body); }

// Finds the neighbours of parts.
class Neighbourhood {
 public:
  Neighbourhood(const Model& model, const RigidParts& parts)
      : model_(model),
        parts_(parts),
        poses_(forwardKinematics(model, referencePosture(model))),
        hasContact_(model.bodies().size()),
        isFrame_(model.bodies().size(), true) {
    for (std::size_t i = 0; i < isFrame_.size(); ++i)
      if (model.bodies()[i].mass > 0) isFrame_[placeOf(parts.part(BodyId{static_cast<int>(i)}))] = false;
    for (const ModelShape& shape : model.shapes()) {
      isFrame_[placeOf(parts.part(shape.body))] = false;
      if (shape.contact) hasContact_[placeOf(shape.body)] = true;
    }
  }

  // The next part towards the world from the one that `carrier` carries. Parts that are only a frame
  // between two joints at one position are skipped.
  std::optional<BodyId> above(BodyId carrier) const {
    for (;;) {
      const Joint& joint = model_[model_[carrier].joint];
      if (joint.type == JointType::kFree) return {};
      const BodyId part = parts_.part(joint.parent);
      if (part == kWorld) return fixedNeighbour(joint.parent);
      if (!isFrame_[placeOf(part)] || !areInOnePlace(model_[model_[part].joint], joint)) return part;
      carrier = part;
    }
  }

  // Bodies fixed in the world may be far apart: only the body that carries the joint counts, or the next
  // one towards the world that has a shape in contact.
  BodyId fixedNeighbour(BodyId body) const {
    while (!hasContact_[placeOf(body)] && body != kWorld && model_[body].parent != kWorld)
      body = model_[body].parent;
    return body;
  }

 private:
  bool areInOnePlace(const Joint& upper, const Joint& lower) const {
    const Eigen::Vector3d p_WM = poses_[upper.child] * upper.X_MC.inverse().p;
    const Eigen::Vector3d p_WF = poses_[lower.parent] * lower.X_PF.p;
    return (p_WM - p_WF).norm() <= kSamePlace;
  }

  const Model& model_;
  const RigidParts& parts_;
  BodyPoses poses_;
  std::vector<bool> hasContact_;  // of each body
  std::vector<bool> isFrame_;     // of each part: it has neither mass nor shapes
};

}  // namespace

bool isFixed(const Joint& joint) { return joint.nv == 0 || joint.ratio == 0; }

RigidParts::RigidParts(const Model& model)
    : parts_(model.bodies().size(), kWorld),
      freeJoints_(model.bodies().size(), kNoJoint),
      above_(model.bodies().size()) {
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const Body& body = model.bodies()[i];
    const bool hasJoint = body.joint != kNoJoint;
    const bool moves = hasJoint && !isFixed(model[body.joint]);
    parts_[i] = moves ? BodyId{static_cast<int>(i)} : part(body.parent);
    const bool isFree = hasJoint && model[body.joint].type == JointType::kFree;
    freeJoints_[i] = isFree ? body.joint : freeJoint(body.parent);
  }
  findNeighbours(model);
}

void RigidParts::findNeighbours(const Model& model) {
  const Neighbourhood neighbourhood(model, *this);
  for (std::size_t i = 1; i < parts_.size(); ++i)
    if (placeOf(parts_[i]) == i) above_[i] = neighbourhood.above(parts_[i]);
  const auto end = [&](BodyId body) {
    return part(body) == kWorld ? neighbourhood.fixedNeighbour(body) : part(body);
  };
  for (const Pin& pin : model.pins()) pinned_.emplace(std::minmax(end(pin.a), end(pin.b)));
}

bool RigidParts::arePinned(BodyId a, BodyId b) const {
  return pinned_.contains(std::minmax(node(a), node(b)));
}

bool RigidParts::areNeighbours(BodyId a, BodyId b) const {
  const auto hangsOn = [&](BodyId child, BodyId parent) {
    return part(child) != kWorld && above_[placeOf(part(child))] == node(parent);
  };
  return hangsOn(a, b) || hangsOn(b, a) || arePinned(a, b);
}

}  // namespace rex::internal
