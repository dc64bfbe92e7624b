#include "scene/scene_edit.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "geometry/rotation.h"

namespace rex {
namespace {

[[noreturn]] void fail(const JointSpec& joint, const char* what, std::string found, std::string wanted) {
  throw Error({.what = fmt::format("joint '{}': {}", joint.name, what),
               .where = joint.where,
               .found = std::move(found),
               .wanted = std::move(wanted)});
}

// For const and non-const scenes.
template <class Spec>
auto& bodyNamed(Spec& spec, const std::string& name) {
  std::vector<std::string> known;
  for (auto& body : spec.bodies) {
    if (body.name == name) return body;
    known.push_back(body.name);
  }
  throw Error({.what = fmt::format("scene '{}' has no body '{}'", spec.name, name),
               .nearest = nearestNames(name, known)});
}

// The joint that a body hangs on, or null.
const JointSpec* jointInto(const SceneSpec& spec, const std::string& body) {
  const auto found = std::find_if(spec.joints.begin(), spec.joints.end(),
                                  [&](const JointSpec& joint) { return joint.child == body; });
  return found == spec.joints.end() ? nullptr : &*found;
}

// The joints from a body up to its root.
std::vector<const JointSpec*> jointsAbove(const SceneSpec& spec, const std::string& body) {
  std::vector<const JointSpec*> path;
  for (const JointSpec* joint = jointInto(spec, body); joint != nullptr;
       joint = jointInto(spec, joint->parent)) {
    path.push_back(joint);
    if (path.size() > spec.joints.size()) fail(*joint, "loop", "joints that lead back to it", "a tree");
  }
  return path;
}

const JointSpec* follower(const SceneSpec& spec, const JointSpec& joint) {
  const auto found = std::find_if(spec.joints.begin(), spec.joints.end(),
                                  [&](const JointSpec& other) { return other.mimic == joint.name; });
  return found == spec.joints.end() ? nullptr : &*found;
}

Eigen::VectorXd initialCoordinates(const JointSpec& joint) {
  const Eigen::VectorXd q = joint.start();
  const int n = positionCount(joint.type);
  if (q.size() != n)
    fail(joint, "initial coordinates", fmt::format("{} numbers", q.size()), fmt::format("{}", n));
  return q;
}

Eigen::VectorXd initialCoordinates(const SceneSpec& spec, const JointSpec& joint) {
  if (joint.mimic.empty()) return initialCoordinates(joint);
  const auto target = std::find_if(spec.joints.begin(), spec.joints.end(),
                                   [&](const JointSpec& other) { return other.name == joint.mimic; });
  if (target == spec.joints.end() || !target->mimic.empty() ||
      positionCount(target->type) != positionCount(joint.type)) {
    fail(joint, "mimic", fmt::format("'{}'", joint.mimic),
         "a joint that mimics no other and has as many coordinates");
  }
  return (joint.mimicRatio * initialCoordinates(*target).array() + joint.mimicOffset).matrix();
}

Pose initialMotion(const SceneSpec& spec, const JointSpec& joint) {
  return jointMotion(joint.type, joint.axis, joint.pitch, initialCoordinates(spec, joint).data());
}

Eigen::VectorXd reordered(const Eigen::VectorXd& values, const JointReversal& reversal) {
  Eigen::VectorXd turned(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const auto [from, sign] = reversal.coordinates[static_cast<std::size_t>(i)];
    turned[i] = sign * values[from];
  }
  return turned;
}

void requireReversible(const SceneSpec& spec, const JointSpec& joint) {
  if (joint.parent == kWorldName)
    fail(joint, "cannot be reversed", "a joint of the world", "a joint of a body");
  if (positionCount(joint.type) <= 1) return;
  if (!joint.mimic.empty() || follower(spec, joint) != nullptr)
    fail(joint, "cannot be reversed", "a mimic with several coordinates", "one coordinate, or no mimic");
  if (joint.type == JointType::kFree && joint.lower.size() > 0)
    fail(joint, "cannot be reversed", "limits of a free joint", "none");
  if (joint.type == JointType::kFree && (joint.armature > 0 || joint.stiffness > 0))
    fail(joint, "cannot be reversed", "an armature or a spring of a free joint", "none");
  const auto requireCount = [&](const Eigen::VectorXd& values, const char* what) {
    if (values.size() != 0 && values.size() != positionCount(joint.type))
      fail(joint, what, fmt::format("{} numbers", values.size()),
           fmt::format("{}", positionCount(joint.type)));
  };
  requireCount(joint.lower, "limits");
  requireCount(joint.upper, "limits");
  requireCount(joint.springReference, "reference of the spring");
}

// X_FM(q)^-1 is the motion of a joint, too. With one coordinate it is the motion about the opposite axis.
void reverse(JointSpec& joint) {
  const JointReversal reversal = reversalOf(joint.type);
  const Pose X_PF = joint.X_MC.inverse() * reversal.X_FC;
  joint.X_MC = reversal.X_FC.inverse() * joint.X_PF.inverse();
  joint.X_PF = X_PF;
  std::swap(joint.parent, joint.child);
  joint.axis = -joint.axis;
  if (joint.type == JointType::kFree && joint.q0.size() > 0)
    joint.q0 = jointCoordinates(joint.type, joint.axis,
                                jointMotion(joint.type, joint.axis, 0, joint.q0.data()).inverse());
  joint.type = reversal.type;
  if (reversal.count == 0) return;
  joint.q0 = reordered(joint.q0, reversal);
  joint.springReference = reordered(joint.springReference, reversal);
  const int n = positionCount(joint.type);
  if (joint.lower.size() == 0 && joint.upper.size() > 0) joint.lower.setConstant(n, -kUnlimited);
  if (joint.upper.size() == 0 && joint.lower.size() > 0) joint.upper.setConstant(n, kUnlimited);
  const Eigen::VectorXd one = reordered(joint.lower, reversal), other = reordered(joint.upper, reversal);
  joint.lower = one.cwiseMin(other);
  joint.upper = one.cwiseMax(other);
}

}  // namespace

SceneSpec atPositions(SceneSpec spec, const VectorArg& q) {
  const Model model = compile(spec);
  requireSize("joint positions q", q.size(), model.nq());
  for (const Joint& joint : model.joints()) {
    if (joint.mimics || joint.nq == 0) continue;
    const auto same = std::find_if(spec.joints.begin(), spec.joints.end(),
                                   [&](const JointSpec& one) { return one.name == joint.name; });
    same->q0 = q.segment(joint.qIndex, joint.nq);
  }
  return spec;
}

std::size_t removeMeshesWithoutFile(SceneSpec& spec) {
  const auto isWithoutFile = [](const ShapeSpec& shape) {
    return usesMesh(shape.shape.type) && shape.meshFile.empty() && shape.meshPath.empty();
  };
  std::size_t count = std::erase_if(spec.worldShapes, isWithoutFile);
  for (BodySpec& body : spec.bodies) count += std::erase_if(body.shapes, isWithoutFile);
  return count;
}

Pose initialPose(const SceneSpec& spec, const std::string& body) {
  if (body == kWorldName) return {};
  const std::vector<const JointSpec*> path = jointsAbove(spec, body);
  const std::string& root = path.empty() ? body : path.back()->parent;
  Pose X_WB = root == kWorldName ? Pose{} : bodyNamed(spec, root).X_WB;
  for (auto joint = path.rbegin(); joint != path.rend(); ++joint)
    X_WB = X_WB * (*joint)->X_PF * initialMotion(spec, **joint) * (*joint)->X_MC;
  return X_WB;
}

SceneSpec reconfigureRoot(SceneSpec spec, const std::string& body) {
  bodyNamed(spec, body).X_WB = initialPose(spec, body);
  std::vector<std::string> names;
  for (const JointSpec* joint : jointsAbove(spec, body)) {
    requireReversible(spec, *joint);
    names.push_back(joint->name);
  }
  for (JointSpec& joint : spec.joints)
    if (std::find(names.begin(), names.end(), joint.name) != names.end()) reverse(joint);
  spec.postures.clear();
  return spec;
}

}  // namespace rex
