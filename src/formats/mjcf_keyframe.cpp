#include <set>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

// MuJoCo numbers the coordinates in the order in which the joints stand in the file, which is that of the
// tree.
int coordinatesOf(const BodyTree& tree) {
  int count = 0;
  for (const urdf::ReadJoint& joint : tree.joints) count += positionCount(joint.spec.type);
  return count;
}

// Empty without a qpos: the posture is that of the file. Null if it does not fit, or is no posture.
std::optional<PostureSpec> readKey(const Tag& tag, const BodyTree& tree, const std::string& name) {
  constexpr int kMost = 7000;
  PostureSpec posture{.name = "key:" + name, .where = tag.where()};
  if (!tag.has("qpos")) return posture;
  const Eigen::VectorXd q = tag.numbers("qpos", 0, kMost);
  const int wanted = coordinatesOf(tree);
  if (q.size() != wanted) {
    tag.forgiveAt("qpos", fmt::format("{} numbers", q.size()), fmt::format("{}", wanted),
                  "the posture is left out");
    return {};
  }
  Eigen::Index at = 0;
  for (const urdf::ReadJoint& joint : tree.joints) {
    const int size = positionCount(joint.spec.type);
    if (size > 0) posture.joints.emplace_back(joint.spec.name, q.segment(at, size));
    if (size >= 4 && !(q.segment<4>(at + size - 4).norm() > 1e-9)) {
      tag.forgiveAt("qpos", fmt::format("a quaternion of length zero of joint '{}'", joint.spec.name),
                    "another one", "the posture is left out");
      return {};
    }
    at += size;
  }
  return posture;
}

}  // namespace

void readKeyframes(const std::vector<Tag>& sections, Files& files, BodyTree& tree) {
  std::set<std::string> names;
  int count = 0;
  for (const Tag& section : sections) {
    for (const Tag& given : files.children(section.of("<keyframe>"), knownOf("keyframe"))) {
      if (given.name() != "key") continue;
      // Those without a name have their number instead.
      const std::string name = given.has("name") ? given.nameIn("name") : fmt::format("{}", count);
      const Tag tag = given.of(fmt::format("key '{}'", name));
      ++count;
      tag.expect(knownOf("key"));
      if (!names.insert(name).second)
        tag.fail(tag.where(), "a second key of this name", "", "a name of its own");
      if (std::optional<PostureSpec> posture = readKey(tag, tree, name))
        tree.spec.postures.push_back(std::move(*posture));
    }
  }
}

}  // namespace rex::mjcf
