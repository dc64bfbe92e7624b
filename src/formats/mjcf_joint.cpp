#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"

namespace rex::mjcf {
namespace {

const std::vector<std::string> kJointWords = {"hinge", "slide", "ball", "free"};
constexpr JointType kTypesOfMjcf[] = {JointType::kHinge, JointType::kSlider, JointType::kBall,
                                      JointType::kFree};

Eigen::Vector3d jointAxis(const Styled& styled) {
  const Tag& giver = styled.giver("axis");
  if (!giver.has("axis")) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis = giver.numbers("axis", 3);
  const double length = axis.stableNorm();
  if (!(length > 1e-100 && length < 1e100))
    giver.failAt("axis", xml::quoted(giver.text("axis")), "a direction");
  return axis / length;
}

double coordinate(const JointSpec& joint, double given, const Compiler& compiler) {
  return joint.type == JointType::kHinge ? compiler.angle(given) : given;
}

void readRange(const Styled& styled, const Compiler& compiler, JointSpec& joint) {
  if (!isLimited(styled, "limited", "range", compiler)) return;
  const Tag& giver = styled.giver("range");
  if (positionCount(joint.type) != 1) {
    giver.ignore(
        fmt::format("the range of a <joint> of type '{}'", joint.type == JointType::kBall ? "ball" : "free"));
    return;
  }
  const Eigen::VectorXd range = giver.numbers("range", 2);
  if (range[0] > range[1]) {
    giver.forgiveAt("range", xml::quoted(giver.text("range")), "a lower limit that is not above the upper",
                    "the joint has no range");
    return;
  }
  joint.lower = Eigen::VectorXd::Constant(1, coordinate(joint, range[0], compiler));
  joint.upper = Eigen::VectorXd::Constant(1, coordinate(joint, range[1], compiler));
}

void readForceRange(const Styled& styled, const Compiler& compiler, JointSpec& joint) {
  if (positionCount(joint.type) != 1) return;
  if (!isLimited(styled, "actuatorfrclimited", "actuatorfrcrange", compiler)) return;
  const Eigen::VectorXd range = styled.giver("actuatorfrcrange").numbers("actuatorfrcrange", 2);
  joint.maxEffort = range.cwiseAbs().maxCoeff();
}

double slowing(const Styled& styled, const char* attribute) {
  return styled.giver(attribute).notNegative(attribute, 0);
}

}  // namespace

const Known& knownOfJoint() {
  static const Known kKnown = {
      {"name", "class", "type", "pos", "axis", "range", "limited", "ref", "damping", "frictionloss",
       "actuatorfrcrange", "actuatorfrclimited"},
      {},
      {},
      {"group", "springdamper", "stiffness", "springref", "armature", "margin", "solreflimit", "solimplimit",
       "solreffriction", "solimpfriction", "user", "actuatorgravcomp"}};
  return kKnown;
}

JointSpec readBodyJoint(const Styled& styled, const Compiler& compiler) {
  const Tag& tag = styled.own();
  JointSpec joint;
  if (tag.has("name")) joint.name = tag.nameIn("name");
  joint.where = tag.where();
  const Tag& typed = styled.giver("type");
  joint.type = kTypesOfMjcf[typed.has("type") ? choice(typed, "type", kJointWords) : 0];
  joint.damping = slowing(styled, "damping");
  joint.friction = slowing(styled, "frictionloss");
  readRange(styled, compiler, joint);
  if (joint.type == JointType::kFree) return joint;
  const Tag& placed = styled.giver("pos");
  const Pose X_BF{Eigen::Matrix3d::Identity(),
                  placed.has("pos") ? Eigen::Vector3d(placed.numbers("pos", 3)) : Eigen::Vector3d::Zero()};
  joint.X_PF = X_BF;
  joint.X_MC = X_BF.inverse();
  if (joint.type == JointType::kBall) return joint;
  joint.axis = jointAxis(styled);
  const double ref = coordinate(joint, styled.number("ref", 0), compiler);
  if (ref != 0) {
    joint.q0 = Eigen::VectorXd::Constant(1, ref);
    joint.X_MC = jointMotion(joint.type, joint.axis, 0, &ref).inverse() * joint.X_MC;
  }
  readForceRange(styled, compiler, joint);
  return joint;
}

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

namespace {

const std::vector<std::string> kMotors = {"motor",       "general", "position", "velocity",
                                          "intvelocity", "damper",  "cylinder"};
const std::vector<std::string> kOtherTargets = {"tendon",  "cranksite", "slidersite",   "site",
                                                "refsite", "body",      "jointinparent"};

const Known& knownOfActuators() {
  static const Known kKnown = [] {
    Known known{{}, kMotors, {"muscle", "adhesion", "plugin"}};
    known.children.emplace_back("include");
    return known;
  }();
  return kKnown;
}

double largest(const Styled& styled, const char* range) {
  return styled.giver(range).numbers(range, 2).cwiseAbs().maxCoeff();
}

// Whether the force is the control times a gain.
bool isMotor(const Styled& styled) {
  if (styled.own().name() == "motor") return true;
  const auto is = [&](const char* attribute, const char* usual) {
    const Tag& giver = styled.giver(attribute);
    return !giver.has(attribute) || giver.text(attribute) == usual;
  };
  return styled.own().name() == "general" && is("gaintype", "fixed") && is("biastype", "none") &&
         is("dyntype", "none");
}

double gainOf(const Styled& styled) {
  const Tag& giver = styled.giver("gainprm");
  if (styled.own().name() == "motor" || !giver.has("gainprm")) return 1;
  return giver.numbers("gainprm", 1, 10)[0];
}

// The largest force or torque on the joint.
double effortOf(const Styled& styled, const Compiler& compiler) {
  const Tag& geared = styled.giver("gear");
  const double gear = geared.has("gear") ? std::abs(geared.numbers("gear", 1, 6)[0]) : 1;
  double force = kUnlimited;
  if (isLimited(styled, "forcelimited", "forcerange", compiler)) force = largest(styled, "forcerange");
  if (isMotor(styled) && isLimited(styled, "ctrllimited", "ctrlrange", compiler))
    force = std::min(force, std::abs(gainOf(styled)) * largest(styled, "ctrlrange"));
  return std::isfinite(force) ? gear * force : force;
}

template <class Names>
[[noreturn]] void failAtUnknown(const Tag& tag, const char* attribute, const char* kind, const Names& names) {
  std::vector<std::string> known;
  for (const auto& [name, unused] : names) known.push_back(name);
  std::sort(known.begin(), known.end());
  const std::string& name = tag.text(attribute);
  tag.fail(tag.where(attribute), fmt::format("unknown {}", kind), xml::quoted(name),
           fmt::format("the name of a {}", kind), nearestNames(name, known));
}

JointSpec& jointIn(const Tag& tag, const char* attribute, BodyTree& tree) {
  const auto found = tree.jointOfName.find(tag.nameIn(attribute));
  if (found == tree.jointOfName.end()) failAtUnknown(tag, attribute, "joint", tree.jointOfName);
  return tree.joints[found->second].spec;
}

// A joint that follows another: q = ratio * (q of the other) + offset, before chains are resolved.
struct Follower {
  Tag tag;
  std::string leader;
  double ratio = 1, offset = 0;
};

double startOf(const JointSpec& joint) { return joint.q0.size() > 0 ? joint.q0[0] : 0; }

// Empty for what rex cannot represent.
std::optional<Follower> followerOf(const Styled& styled, BodyTree& tree) {
  const Tag& tag = styled.own();
  const JointSpec& joint = jointIn(tag, "joint1", tree);
  const Tag& shaped = styled.giver("polycoef");
  Eigen::VectorXd a = (Eigen::VectorXd(5) << 0, 1, 0, 0, 0).finished();
  if (shaped.has("polycoef")) {
    const Eigen::VectorXd given = shaped.numbers("polycoef", 1, 5);
    a.head(given.size()) = given;
  }
  const Tag& active = styled.giver("active");
  if (active.has("active") && !flag(active, "active")) return {};
  if (!tag.has("joint2")) {
    tag.ignore("a <joint> in <equality> that holds a joint in place");
    return {};
  }
  const JointSpec& leader = jointIn(tag, "joint2", tree);
  for (const JointSpec* one : {&joint, &leader})
    if (positionCount(one->type) != 1)
      tag.fail(tag.where(one == &joint ? "joint1" : "joint2"), "a joint that follows another",
               fmt::format("'{}' of type '{}'", one->name, toString(one->type)),
               "two joints of type hinge or slide");
  if (&joint == &leader) tag.fail(tag.where("joint2"), "a joint that follows itself", "", "another joint");
  if (!a.tail(3).isZero(0)) {
    tag.ignore("a <joint> in <equality> with a polynomial of higher degree");
    return {};
  }
  return Follower{tag, leader.name, a[1], startOf(joint) + a[0] - a[1] * startOf(leader)};
}

// Follows the chain of leaders to its end; false if it is a loop.
bool resolve(const std::string& joint, Follower& follower, const std::map<std::string, Follower>& followers) {
  for (std::size_t steps = 0; steps <= followers.size(); ++steps) {
    if (follower.leader == joint) return false;
    const auto next = followers.find(follower.leader);
    if (next == followers.end()) return true;
    follower.offset += follower.ratio * next->second.offset;
    follower.ratio *= next->second.ratio;
    follower.leader = next->second.leader;
  }
  return false;
}

const Known& knownOfEqualities() {
  static const Known kKnown = {{},
                               {"include", "joint", "connect"},
                               {"weld", "tendon", "flex", "flexvert", "flexstrain", "distance", "plugin"}};
  return kKnown;
}

}  // namespace

const std::string& bodyIn(const Tag& tag, const char* attribute, const BodyTree& tree) {
  const std::string& name = tag.nameIn(attribute);
  if (name != kWorldName && !tree.bodyOfName.contains(name))
    failAtUnknown(tag, attribute, "body", tree.bodyOfName);
  return name;
}

const Known& knownOfActuator() {
  static const Known kKnown = [] {
    Known known{
        {"name", "class", "joint", "gear", "ctrlrange", "ctrllimited", "forcerange", "forcelimited",
         "gaintype", "biastype", "dyntype", "gainprm"},
        {},
        {},
        {"group",       "lengthrange", "user",     "actdim", "actearly",  "actlimited", "actrange",
         "biasprm",     "dynprm",      "kp",       "kv",     "dampratio", "timeconst",  "inheritrange",
         "cranklength", "area",        "diameter", "bias",   "delay",     "nsample"}};
    known.attributes.insert(known.attributes.end(), kOtherTargets.begin(), kOtherTargets.end());
    return known;
  }();
  return kKnown;
}

void readActuators(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                   const Compiler& compiler, BodyTree& tree) {
  std::unordered_map<std::string, double> efforts;
  for (const Tag& section : sections) {
    for (const Tag& tag : files.children(section.of("<actuator>"), knownOfActuators())) {
      if (std::find(kMotors.begin(), kMotors.end(), tag.name()) == kMotors.end()) continue;
      tag.expect(knownOfActuator());
      if (!tag.has("joint")) {
        tag.ignore("an actuator of something other than a joint");
        continue;
      }
      const Styled styled(tag, defaults.named(tag, "class", defaults.main()), Kind::kActuator);
      const JointSpec& joint = jointIn(tag, "joint", tree);
      if (positionCount(joint.type) != 1) {
        tag.ignore("an actuator of a joint of type 'ball' or 'free'");
        continue;
      }
      efforts[joint.name] += effortOf(styled, compiler);
    }
  }
  for (const auto& [name, effort] : efforts) {
    JointSpec& joint = tree.joints[tree.jointOfName.at(name)].spec;
    joint.maxEffort = std::min(joint.maxEffort, effort);
  }
}

const Known& knownOfEquality() {
  static const Known kKnown = {
      {"name", "class", "joint1", "joint2", "polycoef", "active"}, {}, {}, {"solref", "solimp"}};
  return kKnown;
}

void readEqualities(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                    const Compiler& compiler, BodyTree& tree) {
  std::map<std::string, Follower> followers;
  std::vector<Tag> pins;
  for (const Tag& section : sections) {
    for (const Tag& tag : files.children(section.of("<equality>"), knownOfEqualities())) {
      if (tag.name() == "connect") pins.push_back(tag);
      if (tag.name() != "joint") continue;
      tag.expect(knownOfEquality());
      const Styled styled(tag, defaults.named(tag, "class", defaults.main()), Kind::kEquality);
      const std::optional<Follower> follower = followerOf(styled, tree);
      if (follower && !followers.emplace(tag.text("joint1"), *follower).second)
        tag.warn(tag.where("joint1"),
                 fmt::format("'{}' already follows another joint; this is ignored", tag.text("joint1")));
    }
  }
  for (const auto& [name, unresolved] : followers) {
    Follower follower = unresolved;
    if (!resolve(name, follower, followers)) {
      follower.tag.warn(follower.tag.where(), "joints that follow each other in a loop; this is ignored");
      continue;
    }
    JointSpec& joint = tree.joints[tree.jointOfName.at(name)].spec;
    joint.mimic = follower.leader;
    joint.mimicRatio = follower.ratio;
    joint.mimicOffset = follower.offset;
  }
  readPins(pins, defaults, compiler, tree);
}

}  // namespace rex::mjcf
