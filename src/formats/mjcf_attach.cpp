#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

// The joint into each body but roots.
std::unordered_map<std::string, const JointSpec*> jointsInto(const BodyTree& tree) {
  std::unordered_map<std::string, const JointSpec*> into;
  for (const JointSpec& joint : tree.spec.joints) into.emplace(joint.child, &joint);
  return into;
}

// The bodies that come along: those of the tag's body, with the massless ones that carry it, or all.
std::set<std::string> bodiesToAttach(const BodyTree& tree, const Tag& tag) {
  std::set<std::string> names;
  if (!tag.has("body")) {
    for (const BodySpec& body : tree.spec.bodies) names.insert(body.name);
    return names;
  }
  const std::string& name = tag.nameIn("body");
  const auto isIt = [&](const BodyInFile& one) { return tree.spec.bodies[one.body].name == name; };
  const auto found = std::ranges::find_if(tree.bodies, isIt);
  if (found == tree.bodies.end())
    tag.failAt("body", xml::quoted(name), fmt::format("a body of the model '{}'", tag.text("model")));
  const auto into = jointsInto(tree);
  names.insert(name);
  std::string top = name;
  for (std::size_t i = 1; i < found->joints; ++i) names.insert(top = into.at(top)->parent);
  for (const JointSpec& joint : tree.spec.joints)
    if (names.contains(joint.parent)) names.insert(joint.child);
  return names;
}

MassProperties massOf(const BodySpec& body) {
  return {body.mass, body.p_BBcm, body.inertia.value_or(Eigen::Matrix3d::Zero())};
}

// Takes what belongs to the bodies that come along, with other names.
class Part {
 public:
  Part(const BodyTree& whole, const Tag& tag, const Rename& renamed)
      : whole_(whole), names_(bodiesToAttach(whole, tag)), renamed_(renamed) {
    for (const JointSpec& joint : whole.spec.joints)
      if (comes(joint.child)) joints_.insert(joint.name);
    takeBodies();
    takeJoints();
    takeReferences();
    if (!tag.has("body")) part_.spec.worldShapes = whole.spec.worldShapes;
  }
  BodyTree take() { return std::move(part_); }

 private:
  bool comes(const std::string& body) const { return names_.contains(body); }
  // The world stands for whatever the part is attached to.
  std::string nameOf(const std::string& body) const { return comes(body) ? renamed_(body) : kWorldName; }

  void takeBodies() {
    for (std::size_t i = 0; i < whole_.spec.bodies.size(); ++i) {
      BodySpec body = whole_.spec.bodies[i];
      if (!comes(body.name)) continue;
      const std::string name = renamed_(body.name);
      for (ShapeSpec& shape : body.shapes) shape.name = renamed_(shape.name);
      const auto inFile = std::ranges::find(whole_.bodies, i, &BodyInFile::body);
      if (inFile != whole_.bodies.end())
        part_.bodies.push_back({.body = part_.spec.bodies.size(),
                                .parent = nameOf(inFile->parent),
                                .joints = inFile->joints,
                                .given = massOf(body),
                                .hasGeoms = inFile->hasGeoms});
      for (const auto& [geom, at] : whole_.geomOfName)
        if (at.body == i)
          part_.geomOfName.emplace(renamed_(geom), GeomInTree{part_.spec.bodies.size(), at.first, at.count});
      part_.bodyOfName.emplace(name, part_.spec.bodies.size());
      body.name = name;
      part_.spec.bodies.push_back(std::move(body));
    }
  }

  void takeJoints() {
    for (JointSpec joint : whole_.spec.joints) {
      if (!comes(joint.child)) continue;
      joint.name = renamed_(joint.name);
      joint.parent = nameOf(joint.parent);
      joint.child = renamed_(joint.child);
      joint.mimic = joints_.contains(joint.mimic) ? renamed_(joint.mimic) : "";
      part_.jointOfName.emplace(joint.name, part_.joints.size());
      part_.joints.push_back({std::move(joint), {}, {}, {}});
    }
  }

  // What names things outside of the part stays behind.
  void takeReferences() {
    for (PinSpec pin : whole_.spec.pins) {
      if (!comes(pin.a) || !comes(pin.b)) continue;
      pin.a = renamed_(pin.a), pin.b = renamed_(pin.b);
      part_.spec.pins.push_back(std::move(pin));
    }
    for (CollisionChoice choice : whole_.spec.collisionChoices) {
      if (!comes(choice.a) || !comes(choice.b)) continue;
      choice.a = renamed_(choice.a), choice.b = renamed_(choice.b);
      part_.spec.collisionChoices.push_back(std::move(choice));
    }
    for (const auto& [name, ends] : whole_.tendons) {
      std::vector<std::pair<std::string, double>> kept;
      for (const auto& [joint, coefficient] : ends)
        if (joints_.contains(joint)) kept.emplace_back(renamed_(joint), coefficient);
      if (kept.size() == ends.size()) part_.tendons.emplace(renamed_(name), std::move(kept));
    }
    for (PostureSpec posture : whole_.spec.postures) {
      constexpr std::size_t kKey = 4;  // "key:"
      std::erase_if(posture.joints, [&](const auto& one) { return !joints_.contains(one.first); });
      for (auto& [joint, q] : posture.joints) joint = renamed_(joint);
      posture.name = posture.name.substr(0, kKey) + renamed_(posture.name.substr(kKey));
      part_.spec.postures.push_back(std::move(posture));
    }
  }

  const BodyTree& whole_;
  std::set<std::string> names_, joints_{};
  const Rename& renamed_;
  BodyTree part_{};
};

void placeRoot(const Tag& tag, const std::string& parent, const Pose& X_PF, JointSpec& joint) {
  joint.parent = parent;
  if (joint.type != JointType::kFree) {
    joint.X_PF = X_PF * joint.X_PF;
    return;
  }
  if (parent != kWorldName)
    tag.fail(tag.where(), "a free joint", fmt::format("a body on '{}'", parent), "a body on the world");
  const Pose X_WB = jointMotion(joint.type, joint.axis, joint.pitch, joint.start().data());
  joint.q0 = joint.springReference = jointCoordinates(joint.type, joint.axis, X_PF * X_WB);
}

template <class Things>
void append(Things& things, Things more) {
  things.insert(things.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

BodyTree partToAttach(const BodyTree& whole, const Tag& tag, const Rename& renamed) {
  for (const PinSpec& pin : whole.spec.pins)
    if (pin.a == kWorldName || pin.b == kWorldName)
      tag.remark("a <connect> or <weld> to the world in a model that is attached is left out",
                 Difference::kMotion);
  return Part(whole, tag, renamed).take();
}

void graft(const Tag& tag, BodyTree part, const std::string& parent, const Pose& X_PF, BodyTree& tree) {
  const std::size_t first = tree.spec.bodies.size();
  if (!part.spec.worldShapes.empty() && parent != kWorldName)
    tag.remark("geoms of the world of a model that is attached to a body weigh nothing", Difference::kMotion);
  const auto owner =
      parent == kWorldName ? std::optional<std::size_t>() : std::optional(tree.bodyOfName.at(parent));
  for (ShapeSpec& shape : part.spec.worldShapes) shape.X_BS = X_PF * shape.X_BS;
  append(tree.shapesOf(owner), std::move(part.spec.worldShapes));
  const auto into = [&] {
    std::set<std::string> names;
    for (const urdf::ReadJoint& joint : part.joints) names.insert(joint.spec.child);
    return names;
  }();
  for (urdf::ReadJoint& read : part.joints) {
    if (read.spec.parent == kWorldName) placeRoot(tag, parent, X_PF, read.spec);
    tree.jointOfName.emplace(read.spec.name, tree.joints.size());
    tree.joints.push_back(std::move(read));
  }
  for (BodySpec& body : part.spec.bodies) {
    tree.bodyOfName.emplace(body.name, tree.spec.bodies.size());
    if (!into.contains(body.name)) {
      body.X_WB = X_PF * body.X_WB;
      if (parent != kWorldName) {
        JointSpec fixed;
        fixed.name = fmt::format("{}>{}", parent, body.name);
        fixed.parent = parent;
        fixed.child = body.name;
        fixed.type = JointType::kRigid;
        fixed.X_PF = std::exchange(body.X_WB, Pose{});
        fixed.where = body.where;
        tree.jointOfName.emplace(fixed.name, tree.joints.size());
        tree.joints.push_back({std::move(fixed), {}, {}, {}});
      }
    }
    tree.spec.bodies.push_back(std::move(body));
  }
  for (BodyInFile& one : part.bodies) {
    one.body += first;
    if (one.parent == kWorldName) one.parent = parent;
    tree.bodies.push_back(std::move(one));
  }
  for (auto& [name, at] : part.geomOfName) {
    at.body = *at.body + first;
    tree.geomOfName.emplace(name, at);
  }
  tree.tendons.merge(part.tendons);
  append(tree.spec.pins, std::move(part.spec.pins));
  append(tree.spec.collisionChoices, std::move(part.spec.collisionChoices));
  append(tree.spec.postures, std::move(part.spec.postures));
}

}  // namespace rex::mjcf
