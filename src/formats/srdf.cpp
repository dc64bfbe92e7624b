#include "formats/srdf.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "formats/assets_internal.h"
#include "formats/urdf_expansion_internal.h"
#include "formats/urdf_parts_internal.h"

namespace rex {
namespace {

using namespace urdf;

constexpr std::size_t kLargestSrdf = 8u << 20;

// Tags of an SRDF that are for other programs.
const std::vector<std::string> kOfOthers = {"group",
                                            "end_effector",
                                            "virtual_joint",
                                            "passive_joint",
                                            "joint_property",
                                            "chained_to",
                                            "link_sphere_approximation"};
const std::vector<std::string> kReadTags = {"disable_collisions", "enable_collisions",
                                            "disable_default_collisions", "group_state"};

bool isOfOthers(const std::string& name) {
  return std::find(kOfOthers.begin(), kOfOthers.end(), name) != kOfOthers.end();
}

void requireSrdf(const xml::Document& document) {
  const xml::Element& root = document.root;
  const auto isUrdf = [](const xml::Element& child) { return child.name == "link" || child.name == "joint"; };
  const auto part = std::find_if(root.children.begin(), root.children.end(), isUrdf);
  const bool isRobot = root.name == "robot";
  if (isRobot && part == root.children.end()) return;
  const xml::Element& wrong = isRobot ? *part : root;
  throw Error({.what = "not an SRDF",
               .where = document.where(wrong.at),
               .found = fmt::format("<{}>{}", wrong.name, isRobot ? ", a part of a URDF" : ""),
               .wanted = isRobot ? "a semantic description, such as <disable_collisions>" : "<robot>",
               .nearest = isRobot ? std::vector<std::string>{} : nearestNames(root.name, {"robot"})});
}

class SrdfReader {
 public:
  SrdfReader(Reading& reading, SceneFile& robot) : reading_(reading), robot_(robot) {
    for (const BodySpec& body : robot.spec.bodies) links_.insert(body.name);
    links_.insert(kWorldName);
  }

  void read() {
    static const Known kKnown = [] {
      Known known{{"name", "version"}, kReadTags};
      known.children.insert(known.children.end(), kOfOthers.begin(), kOfOthers.end());
      return known;
    }();
    const Tag robot(reading_, reading_.document.root, "<robot>");
    robot.expect(kKnown);
    for (const Tag& tag : robot.children()) {
      if (tag.name() == kReadTags[0]) addPair(tag, false);
      if (tag.name() == kReadTags[1]) addPair(tag, true);
      if (tag.name() == kReadTags[2]) addAll(tag);
      if (tag.name() == kReadTags[3]) addState(tag.of("<group_state>"));
    }
  }

  // What else the file holds, in one note. Groups that have states are there for these.
  void noteOthers(Diagnostics& notes) const {
    std::map<std::string, int> counts;
    const xml::Element* first = nullptr;
    for (const xml::Element& child : reading_.document.root.children) {
      if (!isOfOthers(child.name) || isUsed(child)) continue;
      if (first == nullptr) first = &child;
      ++counts[child.name];
    }
    if (first == nullptr) return;
    std::vector<std::string> kinds;
    for (const auto& [name, count] : counts)
      kinds.push_back(count > 1 ? fmt::format("<{}> ({} times)", name, count) : fmt::format("<{}>", name));
    notes.push_back(
        {reading_.document.where(first->at),
         fmt::format("only collisions and states of an SRDF are read: {} skipped", join(kinds, ", "))});
  }

 private:
  bool isUsed(const xml::Element& tag) const {
    return tag.name == "group" && std::ranges::any_of(tag.attributes, [&](const xml::Attribute& one) {
             return one.name == "name" && groups_.contains(one.value);
           });
  }

  // Whether the robot has the link that an attribute names.
  bool hasLink(const Tag& tag, const char* attribute) const {
    const std::string& name = tag.nameIn(attribute);
    if (links_.contains(name)) return true;
    warnOfUnknown(tag, attribute, "link", name, {links_.begin(), links_.end()});
    return false;
  }

  void addPair(const Tag& tag, bool mayCollide) {
    static const Known kKnown = {{"link1", "link2", "reason"}, {}};
    tag.expect(kKnown);
    const bool isKnown = hasLink(tag, "link1");  // each of the two gets its warning
    if (!hasLink(tag, "link2") || !isKnown) return;
    CollisionChoice choice{tag.text("link1"), tag.text("link2"), mayCollide,
                           tag.has("reason") ? tag.text("reason") : "", tag.where()};
    if (choice.a == choice.b) tag.fail(tag.where("link2"), "one link", xml::quoted(choice.a), "two links");
    add(tag, std::move(choice));
  }

  void addAll(const Tag& tag) {
    static const Known kKnown = {{"link"}, {}};
    tag.expect(kKnown);
    if (hasLink(tag, "link")) add(tag, {tag.text("link"), "", false, "", tag.where()});
  }

  void add(const Tag& tag, CollisionChoice choice) {
    const auto [first, isNew] =
        given_.emplace(std::minmax(choice.a, choice.b), robot_.spec.collisionChoices.size());
    if (!isNew) {
      const CollisionChoice& other = robot_.spec.collisionChoices[first->second];
      const char* const problem = other.mayCollide == choice.mayCollide
                                      ? "is given twice"
                                      : "is both enabled and disabled: disabled counts";
      const std::string who = choice.b.empty() ? fmt::format("'{}'", choice.a)
                                               : fmt::format("the pair '{}' and '{}'", choice.a, choice.b);
      tag.warn(tag.where(),
               [&] { return fmt::format("{} {}; the first is at {}", who, problem, toString(other.where)); });
    }
    robot_.spec.collisionChoices.push_back(std::move(choice));
  }

  // States of several groups with one name are one posture.
  void addState(const Tag& tag) {
    static const Known kKnown = {{"name", "group"}, {"joint"}};
    tag.expect(kKnown);
    const std::string name = "state:" + tag.nameIn("name");
    if (tag.has("group")) groups_.insert(tag.text("group"));
    std::vector<PostureSpec>& postures = robot_.spec.postures;
    auto posture = std::ranges::find(postures, name, &PostureSpec::name);
    if (posture == postures.end())
      posture = postures.insert(postures.end(), {.name = name, .where = tag.where()});
    for (const Tag& joint : tag.children("joint")) addToState(joint, *posture);
  }

  void addToState(const Tag& tag, PostureSpec& posture) {
    static const Known kKnown = {{"name", "value"}, {}};
    tag.expect(kKnown);
    const std::string& name = tag.nameIn("name");
    const auto joint = std::ranges::find(robot_.spec.joints, name, &JointSpec::name);
    if (joint == robot_.spec.joints.end()) {
      std::vector<std::string> names;
      for (const JointSpec& one : robot_.spec.joints) names.push_back(one.name);
      return warnOfUnknown(tag, "name", "joint", name, names);
    }
    if (positionCount(joint->type) != 1)
      return tag.warn(
          tag.where("name"),
          fmt::format("ignored: {} is a {} joint, and only joints with one coordinate have states",
                      xml::quoted(name), toString(joint->type)));
    const Eigen::VectorXd value = tag.numbers("value", 1);
    const auto known = std::ranges::find(posture.joints, name, [](const auto& one) { return one.first; });
    if (known == posture.joints.end()) {
      posture.joints.emplace_back(name, value);
    } else if (known->second != value) {
      tag.warn(tag.where("value"),
               fmt::format("joint {} has another value in '{}' already, which counts: {:g}",
                           xml::quoted(name), posture.name, known->second[0]));
    }
  }

  static void warnOfUnknown(const Tag& tag, const char* attribute, const char* kind, const std::string& name,
                            const std::vector<std::string>& known) {
    tag.warn(tag.where(attribute), [&] {
      const std::vector<std::string> nearest = nearestNames(name, known);
      return fmt::format("the robot has no {} {}: ignored{}", kind, xml::quoted(name),
                         nearest.empty() ? "" : fmt::format(" (did you mean '{}'?)", nearest.front()));
    });
  }

  Reading& reading_;
  SceneFile& robot_;
  std::set<std::string> links_, groups_;                              // groups: those with states
  std::map<std::pair<std::string, std::string>, std::size_t> given_;  // places of choices
};

}  // namespace

void parseSrdf(std::string_view text, const std::string& name, SceneFile& robot) {
  const xml::Document document = xml::parse(text, name);
  refuseXacro(document, "SRDF");
  requireSrdf(document);
  Reading reading{document};
  SrdfReader reader(reading, robot);
  reader.read();
  const Diagnostics found = reading.notes.take();
  robot.notes.insert(robot.notes.end(), found.begin(), found.end());
  reader.noteOthers(robot.notes);
}

void readSrdf(const std::filesystem::path& file, SceneFile& robot) {
  if (const std::string obstacle = internal::obstacleAt(file); !obstacle.empty()) {
    throw Error({.what = "cannot read the collision settings",
                 .where = {file.string()},
                 .found = obstacle,
                 .wanted = "an SRDF file",
                 .nearest = nearestNames(file.filename().string(), internal::namesBeside(file))});
  }
  parseSrdf(readSceneText(file, kLargestSrdf), file.string(), robot);
}

std::string writeSrdf(const std::string& robot, std::span<const CollisionChoice> choices,
                      const std::string& about) {
  urdf::Markup markup;
  if (!about.empty()) markup.text += fmt::format("<!-- {} -->\n", about);
  markup.open("robot", {{"name", robot}});
  for (const CollisionChoice& choice : choices) {
    if (choice.b.empty()) {
      markup.empty("disable_default_collisions", {{"link", choice.a}});
    } else {
      markup.empty(choice.mayCollide ? "enable_collisions" : "disable_collisions",
                   {{"link1", choice.a}, {"link2", choice.b}, {"reason", choice.reason}});
    }
  }
  markup.close("robot");
  return std::move(markup.text);
}

}  // namespace rex
