#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/urdf_parts_internal.h"

namespace rex::urdf {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

[[noreturn]] void fail(const SourceLocation& where, std::string what, std::string found, std::string wanted,
                       std::vector<std::string> nearest = {}) {
  throw Error({std::move(what), where, std::move(found), std::move(wanted), std::move(nearest)});
}

std::string nameOf(const BodySpec& link) { return link.name; }
std::string nameOf(const ReadJoint& joint) { return joint.spec.name; }
const SourceLocation& whereOf(const BodySpec& link) { return link.where; }
const SourceLocation& whereOf(const ReadJoint& joint) { return joint.spec.where; }

// The things by name; names must be unique.
template <class Thing>
class Index {
 public:
  Index(const char* kind, const std::vector<Thing>& things) : kind_(kind), things_(things) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      const auto [first, isNew] = byName_.emplace(nameOf(things[i]), i);
      if (!isNew) {
        fail(whereOf(things[i]), fmt::format("a second {} '{}'", kind, first->first), "",
             fmt::format("a name of its own: the first is at {}", toString(whereOf(things[first->second]))));
      }
    }
  }

  bool has(const std::string& name) const { return byName_.contains(name); }
  std::size_t find(const std::string& name, const SourceLocation& where, const std::string& what) const {
    if (const auto found = byName_.find(name); found != byName_.end()) return found->second;
    throw Error(unknown(name, where, what));
  }
  ErrorParts unknown(const std::string& name, const SourceLocation& where, const std::string& what) const {
    std::vector<std::string> known;
    for (const Thing& thing : things_) known.push_back(nameOf(thing));
    return {what, where, xml::quoted(name), fmt::format("the name of a {}", kind_),
            nearestNames(name, known)};
  }

 private:
  const char* kind_;
  const std::vector<Thing>& things_;
  std::unordered_map<std::string, std::size_t> byName_;
};

// Names for a message, the first few of many.
std::string listed(const std::vector<std::string>& names, const char* between) {
  constexpr std::size_t kShown = 8;
  const auto first = std::span(names).first(std::min(kShown, names.size()));
  const std::string shown = fmt::format("'{}'", join(first, fmt::format("'{}'", between)));
  return names.size() > kShown ? fmt::format("{}{}{} more", shown, between, names.size() - kShown) : shown;
}

// A link in the tree.
struct Hold {
  std::size_t joint = kNone;   // that moves it
  std::size_t parent = kNone;  // link on which that joint sits
};

std::vector<Hold> connect(const std::vector<BodySpec>& links, const std::vector<ReadJoint>& joints) {
  const Index index("link", links);
  std::vector<Hold> holds(links.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointSpec& joint = joints[j].spec;
    const std::string what = fmt::format("joint '{}'", joint.name);
    const std::size_t parent = index.find(joint.parent, joints[j].parentAt, what + ": unknown parent");
    const std::size_t child = index.find(joint.child, joints[j].childAt, what + ": unknown child");
    if (parent == child)
      fail(joints[j].childAt, what + ": parent and child are the same link", xml::quoted(joint.child),
           "two links");
    if (joint.child == "world")
      fail(joints[j].childAt, what + ": child", "'world'", "another link: the world itself does not move");
    if (holds[child].joint != kNone) {
      fail(joints[j].childAt, fmt::format("{}: link '{}' already has a parent", what, joint.child),
           fmt::format("joint '{}'", joints[holds[child].joint].spec.name), "one joint leading to each link");
    }
    holds[child] = {j, parent};
  }
  return holds;
}

std::size_t requireOneRoot(const std::vector<BodySpec>& links, const std::vector<Hold>& holds) {
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (holds[i].joint == kNone) roots.push_back(i);
  if (roots.size() == 1) return roots.front();
  std::vector<std::string> names;
  for (const std::size_t root : roots) names.push_back(links[root].name);
  if (roots.size() > 1)
    fail(links[roots[1]].where, "links that no joint connects", listed(names, ", "), "one root");
  return kNone;
}

// Walks up from each link; links known to lead to the root are not walked again.
void refuseLoops(const std::vector<BodySpec>& links, const std::vector<ReadJoint>& joints,
                 const std::vector<Hold>& holds) {
  enum class Mark { kNew, kOnPath, kDone };
  std::vector<Mark> marks(links.size(), Mark::kNew);
  for (std::size_t start = 0; start < links.size(); ++start) {
    std::vector<std::size_t> path;
    std::size_t at = start;
    for (; at != kNone && marks[at] == Mark::kNew; at = holds[at].parent) {
      marks[at] = Mark::kOnPath;
      path.push_back(at);
    }
    if (at != kNone && marks[at] == Mark::kOnPath) {
      std::vector<std::string> loop = {links[at].name};
      for (std::size_t up = holds[at].parent; up != at; up = holds[up].parent) loop.push_back(links[up].name);
      loop.push_back(links[at].name);
      std::reverse(loop.begin(), loop.end());
      fail(joints[holds[at].joint].spec.where, "joints form a loop", listed(loop, " > "), "a tree");
    }
    for (const std::size_t link : path) marks[link] = Mark::kDone;
  }
}

void leaveOutUnknownMimics(std::vector<ReadJoint>& joints, const Index<ReadJoint>& index, Reading& reading) {
  for (ReadJoint& joint : joints) {
    JointSpec& spec = joint.spec;
    if (spec.mimic.empty() || index.has(spec.mimic)) continue;
    reading.forgive(index.unknown(spec.mimic, joint.mimicAt, fmt::format("joint '{}': mimic", spec.name)),
                    "it is ignored: the joint moves by itself");
    spec.mimic.clear();
    spec.mimicRatio = 1;
    spec.mimicOffset = 0;
  }
}

// A joint that mimics one that mimics another follows the last one.
void resolveMimics(std::vector<ReadJoint>& joints, const Index<ReadJoint>& index, Reading& reading) {
  for (ReadJoint& joint : joints) {
    JointSpec& spec = joint.spec;
    if (spec.mimic.empty()) continue;
    const std::string what = fmt::format("joint '{}': mimic", spec.name);
    const auto targetOf = [&](const std::string& name) -> const JointSpec& {
      return joints[index.find(name, joint.mimicAt, what)].spec;
    };
    const JointSpec& first = targetOf(spec.mimic);
    const ErrorParts fault = {what, joint.mimicAt,
                              fmt::format("'{}', which mimics '{}'", first.name, first.mimic),
                              "a joint that mimics no other"};
    for (const JointSpec* target = &first; !target->mimic.empty(); target = &targetOf(target->mimic)) {
      if (target == &spec) throw Error(fault);
      spec.mimicOffset += spec.mimicRatio * target->mimicOffset;
      spec.mimicRatio *= target->mimicRatio;
      spec.mimic = target->mimic;
    }
    if (positionCount(targetOf(spec.mimic).type) != 1)
      fail(joint.mimicAt, what, fmt::format("'{}'", spec.mimic), "a revolute, continuous or prismatic joint");
    if (spec.mimic != first.name)
      reading.forgive(fault, fmt::format("it follows '{}' with multiplier {} and offset {}", spec.mimic,
                                         spec.mimicRatio, spec.mimicOffset));
  }
}

}  // namespace

std::size_t requireTree(const std::vector<BodySpec>& links, std::vector<ReadJoint>& joints,
                        const SourceLocation& robot, Reading& reading) {
  if (links.empty()) fail(robot, "<robot>: no link", "", "at least one <link>");
  const Index jointIndex("joint", joints);
  const std::vector<Hold> holds = connect(links, joints);
  refuseLoops(links, joints, holds);
  leaveOutUnknownMimics(joints, jointIndex, reading);
  resolveMimics(joints, jointIndex, reading);
  return requireOneRoot(links, holds);
}

}  // namespace rex::urdf
