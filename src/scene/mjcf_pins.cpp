#include <fmt/format.h>

#include "scene/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

constexpr std::size_t kMostPins = 1000;

// X_WB of all bodies where the joints start. Parents come before their children.
std::unordered_map<std::string, Pose> startingPoses(const BodyTree& tree) {
  std::unordered_map<std::string, Pose> poses = {{kWorldName, Pose{}}};
  for (const BodySpec& body : tree.spec.bodies) poses.emplace(body.name, body.X_WB);
  for (const urdf::ReadJoint& read : tree.joints) {
    const JointSpec& joint = read.spec;
    const Pose X_FM = jointMotion(joint.type, joint.axis.normalized(), joint.pitch, joint.start().data());
    poses.at(joint.child) = poses.at(joint.parent) * joint.X_PF * X_FM * joint.X_MC;
  }
  return poses;
}

bool isActive(const Tag& tag, const Defaults& defaults) {
  const Styled styled(tag, defaults.named(tag, "class", defaults.main()), Kind::kEquality);
  const Tag& giver = styled.giver("active");
  return !giver.has("active") || flag(giver, "active");
}

}  // namespace

void readPins(const std::vector<Tag>& tags, const Defaults& defaults, const Compiler& compiler,
              BodyTree& tree) {
  if (tags.empty()) return;
  static const Known kKnown = {{"name", "class", "active", "body1", "body2", "anchor", "site1", "site2"},
                               {},
                               {},
                               {"solref", "solimp"}};
  const std::unordered_map<std::string, Pose> poses = startingPoses(tree);
  for (const Tag& tag : tags) {
    tag.expect(kKnown);
    if (!isActive(tag, defaults)) continue;
    if (tag.has("site1") || tag.has("site2")) {
      tag.ignore("a <connect> of sites");
      continue;
    }
    PinSpec pin{.a = bodyIn(tag, "body1", tree),
                .b = tag.has("body2") ? bodyIn(tag, "body2", tree) : kWorldName,
                .where = tag.where()};
    if (pin.a == pin.b) tag.fail(tag.where("body1"), "one body", xml::quoted(pin.a), "two bodies");
    const Pose &X_WA = poses.at(pin.a), &X_WB = poses.at(pin.b);
    const Eigen::Vector3d anchor = tag.numbers("anchor", 3);
    pin.p_AP = compiler.global ? X_WA.inverse() * anchor : anchor;
    pin.p_BQ = X_WB.inverse() * (X_WA * pin.p_AP);
    if (tree.spec.pins.size() == kMostPins)
      tag.fail(tag.where(), "too many <connect>", "", fmt::format("at most {}", kMostPins));
    tree.spec.pins.push_back(std::move(pin));
  }
}

}  // namespace rex::mjcf
