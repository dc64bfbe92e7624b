#include "support/kdl_tree.h"

#include <cassert>
#include <span>

namespace rex {
namespace {

KDL::Vector kdlVector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

// KDL keeps axis and origin of a joint in the parent's frame.
KDL::Joint kdlJoint(const Joint& joint) {
  const KDL::Vector origin = kdlVector(joint.X_PF.p), axis = kdlVector(joint.X_PF.R * joint.axis);
  if (joint.type == JointType::kHinge) return {joint.name, origin, axis, KDL::Joint::RotAxis};
  if (joint.type == JointType::kSlider) return {joint.name, origin, axis, KDL::Joint::TransAxis};
  assert(joint.type == JointType::kRigid);
  return KDL::Joint(joint.name, KDL::Joint::Fixed);
}

}  // namespace

KDL::Frame kdlFrame(const Pose& X) {
  KDL::Frame frame;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) frame.M(row, column) = X.R(row, column);
    frame.p(row) = X.p[row];
  }
  return frame;
}

Pose poseFrom(const KDL::Frame& frame) {
  Pose X;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) X.R(row, column) = frame.M(row, column);
    X.p[row] = frame.p(row);
  }
  return X;
}

KDL::Tree kdlTree(const Model& model) {
  KDL::Tree tree(model[kWorld].name);
  for (const Body& body : std::span(model.bodies()).subspan(1)) {
    const bool isRoot = body.joint == kNoJoint;
    const KDL::Joint joint = isRoot ? KDL::Joint(KDL::Joint::Fixed) : kdlJoint(model[body.joint]);
    const Pose X_PB = isRoot ? body.X_PB : model[body.joint].X_PF * model[body.joint].X_MC;
    const bool added =
        tree.addSegment(KDL::Segment(body.name, joint, kdlFrame(X_PB)), model[body.parent].name);
    assert(added);
    static_cast<void>(added);
  }
  return tree;
}

KdlChain kdlChain(const Model& model, const KDL::Tree& tree, BodyId body) {
  KdlChain result;
  tree.getChain(model[kWorld].name, model[body].name, result.chain);
  for (BodyId at = body; at != kWorld; at = model[at].parent) {
    const JointId joint = model[at].joint;
    if (joint != kNoJoint && model[joint].nv > 0)
      result.indices.insert(result.indices.begin(), model[joint].qIndex);
  }
  return result;
}

}  // namespace rex
