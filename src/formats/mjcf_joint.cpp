#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "formats/mjcf_parts_internal.h"
#include "geometry/rotation.h"

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
        fmt::format("the range of a <joint> of type '{}'", joint.type == JointType::kBall ? "ball" : "free"),
        Difference::kMotion);
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

void readDrive(const Styled& styled, JointSpec& joint) {
  joint.damping = slowing(styled, "damping");
  joint.friction = slowing(styled, "frictionloss");
  joint.armature = slowing(styled, "armature");
  joint.stiffness = slowing(styled, "stiffness");
}

// MuJoCo does not ask where the spring of a ball rests: at home.
void readSpring(const Styled& styled, const Compiler& compiler, BodyJoint& one) {
  if (styled.has("springdamper")) {
    const Eigen::Vector2d given = styled.giver("springdamper").numbers("springdamper", 2);
    if (given.minCoeff() > 0) one.springDamper = given;
  }
  if (positionCount(one.spec.type) != 1) return;
  const double rest = coordinate(one.spec, styled.number("springref", 0), compiler);
  if (rest != 0) one.spec.springReference = Eigen::VectorXd::Constant(1, rest);
}

}  // namespace

BodyJoint readBodyJoint(const Styled& styled, const Compiler& compiler) {
  const Tag& tag = styled.own();
  BodyJoint one;
  JointSpec& joint = one.spec;
  if (tag.has("name")) joint.name = tag.nameIn("name");
  joint.where = tag.where();
  const Tag& typed = styled.giver("type");
  joint.type = kTypesOfMjcf[typed.has("type") ? choice(typed, "type", kJointWords) : 0];
  readDrive(styled, joint);
  readSpring(styled, compiler, one);
  readRange(styled, compiler, joint);
  if (joint.type == JointType::kFree) return one;
  const Tag& placed = styled.giver("pos");
  const Pose X_BF{Eigen::Matrix3d::Identity(),
                  placed.has("pos") ? Eigen::Vector3d(placed.numbers("pos", 3)) : Eigen::Vector3d::Zero()};
  joint.X_PF = X_BF;
  joint.X_MC = X_BF.inverse();
  if (joint.type == JointType::kBall) return one;
  joint.axis = jointAxis(styled);
  const double ref = coordinate(joint, styled.number("ref", 0), compiler);
  if (ref != 0) {
    joint.q0 = Eigen::VectorXd::Constant(1, ref);
    joint.X_MC = jointMotion(joint.type, joint.axis, 0, &ref).inverse() * joint.X_MC;
  }
  readForceRange(styled, compiler, joint);
  return one;
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

// What holds two bodies together, without its points.
PinSpec pinBetween(const Tag& tag, const BodyTree& tree) {
  PinSpec pin{.a = bodyIn(tag, "body1", tree),
              .b = tag.has("body2") ? bodyIn(tag, "body2", tree) : kWorldName,
              .where = tag.where()};
  if (pin.a == pin.b) tag.fail(tag.where("body1"), "one body", xml::quoted(pin.a), "two bodies");
  return pin;
}

// The pose of body B in A that a <weld> holds: that at the start or, if `relpose` has a quaternion, the one
// in which the point `anchor` of B is at its position.
Pose weldedPose(const Tag& tag, const Pose& X_WA, const Pose& X_WB) {
  const Pose atStart = X_WA.inverse() * X_WB;
  if (!tag.has("relpose")) return atStart;
  const Eigen::VectorXd given = tag.numbers("relpose", 7);
  const double length = given.tail<4>().stableNorm();
  if (length == 0) return atStart;
  if (!(length > 1e-100 && length < 1e100))
    tag.failAt("relpose", xml::quoted(tag.text("relpose")), "a position and a quaternion w x y z");
  Pose X_AB{rotationFromQuaternion(given.tail<4>() / length), given.head<3>()};
  if (tag.has("anchor")) X_AB.p -= X_AB.R * tag.numbers("anchor", 3);
  return X_AB;
}

// Corners of a triangle around the origin of B, metres: where these stay, B does. Of their nine equations
// three follow from the others, which nothing that keeps pins minds.
const Eigen::Vector3d kWelded_B[] = {{0.1, 0, 0}, {-0.05, 0.0866, 0}, {-0.05, -0.0866, 0}};

}  // namespace

void readPins(const std::vector<Tag>& tags, const Defaults& defaults, const Compiler& compiler,
              BodyTree& tree) {
  if (tags.empty()) return;
  const std::unordered_map<std::string, Pose> poses = startingPoses(tree);
  const auto add = [&](const Tag& tag) {
    tag.expect(knownOf(tag.name()));
    if (!isActive(tag, defaults)) return;
    if (tag.has("site1") || tag.has("site2"))
      return tag.ignore(fmt::format("a <{}> of sites", tag.name()), Difference::kMotion);
    PinSpec pin = pinBetween(tag, tree);
    const Pose &X_WA = poses.at(pin.a), &X_WB = poses.at(pin.b);
    const bool isWeld = tag.name() == "weld";
    if (tree.spec.pins.size() + (isWeld ? std::size(kWelded_B) : 1) > kMostPins)
      tag.fail(tag.where(), "too many <connect> and <weld>", "",
               fmt::format("at most {}; a <weld> counts as 3", kMostPins));
    if (isWeld) {
      const Pose X_AB = weldedPose(tag, X_WA, X_WB);
      for (const Eigen::Vector3d& p_BQ : kWelded_B) {
        pin.p_AP = X_AB * p_BQ, pin.p_BQ = p_BQ;
        tree.spec.pins.push_back(pin);
      }
      return;
    }
    const Eigen::Vector3d anchor = tag.numbers("anchor", 3);
    pin.p_AP = compiler.global ? X_WA.inverse() * anchor : anchor;
    pin.p_BQ = X_WB.inverse() * (X_WA * pin.p_AP);
    tree.spec.pins.push_back(std::move(pin));
  };
  for (const Tag& tag : tags) tree.forEachReplica(tag, [&] { add(tag); });
}

namespace {

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

}  // namespace

JointSpec& jointIn(const Tag& tag, const char* attribute, BodyTree& tree) {
  const auto found = tree.jointOfName.find(tree.seen(tag.nameIn(attribute), tree.jointOfName));
  if (found == tree.jointOfName.end()) failAtUnknown(tag, attribute, "joint", tree.jointOfName);
  return tree.joints[found->second].spec;
}

namespace {

// A joint that follows another: q = ratio * (q of the other) + offset, before chains are resolved.
struct Follower {
  Tag tag;
  std::string joint, leader;
  double ratio = 1, offset = 0;
};

double startOf(const JointSpec& joint) { return joint.q0.size() > 0 ? joint.q0[0] : 0; }

// The coefficients of `polycoef`, the constant one first.
Eigen::VectorXd polynomialOf(const Styled& styled) {
  Eigen::VectorXd a = (Eigen::VectorXd(5) << 0, 1, 0, 0, 0).finished();
  if (const Tag& shaped = styled.giver("polycoef"); shaped.has("polycoef")) {
    const Eigen::VectorXd given = shaped.numbers("polycoef", 1, 5);
    a.head(given.size()) = given;
  }
  return a;
}

// Empty for what rex cannot represent.
std::optional<Follower> followerOf(const Styled& styled, BodyTree& tree) {
  const Tag& tag = styled.own();
  const JointSpec& joint = jointIn(tag, "joint1", tree);
  const Eigen::VectorXd a = polynomialOf(styled);
  const Tag& active = styled.giver("active");
  if (active.has("active") && !flag(active, "active")) return {};
  if (!tag.has("joint2")) {
    tag.ignore("a <joint> in <equality> that holds a joint in place", Difference::kMotion);
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
    tag.ignore("a <joint> in <equality> with a polynomial of higher degree", Difference::kMotion);
    return {};
  }
  return Follower{tag, joint.name, leader.name, a[1], startOf(joint) + a[0] - a[1] * startOf(leader)};
}

// What keeps the length of a tendon that hangs on two joints, or makes that of one which hangs on one joint
// follow another one: c q - c q0 = a0 + a1 (d p - d p0), without the second tendon c q + d p is constant.
std::optional<Follower> followerOnTendon(const Styled& styled, BodyTree& tree) {
  const Tag& tag = styled.own();
  const Eigen::VectorXd a = polynomialOf(styled);
  const Tag& active = styled.giver("active");
  if (active.has("active") && !flag(active, "active")) return {};
  using Joints = std::vector<std::pair<std::string, double>>;
  const auto jointsOn = [&](const char* attribute) -> Joints {
    const auto found = tree.tendons.find(tag.nameIn(attribute));
    return found == tree.tendons.end() ? Joints() : found->second;
  };
  Joints ends = jointsOn("tendon1");
  double slope = -1;
  if (tag.has("tendon2")) {
    slope = a[1];
    const Joints second = jointsOn("tendon2");
    if (ends.size() == 1 && second.size() == 1)
      ends.push_back(second[0]);
    else
      ends.clear();
  }
  const auto specOf = [&](std::size_t i) -> JointSpec& {
    return tree.joints[tree.jointOfName.at(ends[i].first)].spec;
  };
  const bool isLinear = ends.size() == 2 && a.tail(3).isZero(0) && ends[0].second != 0 &&
                        ends[0].first != ends[1].first && positionCount(specOf(0).type) == 1 &&
                        positionCount(specOf(1).type) == 1;
  if (!isLinear) {
    tag.ignore("a <tendon> in <equality>, except with <fixed> ones that couple two joints linearly,",
               Difference::kMotion);
    return {};
  }
  const double ratio = slope * ends[1].second / ends[0].second;
  return Follower{tag, ends[0].first, ends[1].first, ratio,
                  startOf(specOf(0)) + a[0] / ends[0].second - ratio * startOf(specOf(1))};
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

}  // namespace

std::string bodyIn(const Tag& tag, const char* attribute, const BodyTree& tree) {
  const std::string name = tree.seen(tag.nameIn(attribute), tree.bodyOfName);
  if (name != kWorldName && !tree.bodyOfName.contains(name))
    failAtUnknown(tag, attribute, "body", tree.bodyOfName);
  return name;
}

namespace {

// Adds the strength of an actuator to that of the joints on which it pulls.
void addEffort(const Styled& styled, const Compiler& compiler, BodyTree& tree,
               std::unordered_map<std::string, double>& efforts) {
  const Tag& tag = styled.own();
  if (tag.has("tendon")) {
    const auto tendon = tree.tendons.find(tag.text("tendon"));
    if (tendon == tree.tendons.end())
      return tag.ignore("an actuator of a spatial tendon", Difference::kMotion);
    for (const auto& [joint, coefficient] : tendon->second)
      if (coefficient != 0) efforts[joint] += std::abs(coefficient) * effortOf(styled, compiler);
    return;
  }
  if (!tag.has("joint"))
    return tag.ignore("an actuator of something other than a joint", Difference::kMotion);
  const JointSpec& joint = jointIn(tag, "joint", tree);
  if (positionCount(joint.type) != 1)
    return tag.ignore("an actuator of a joint of type 'ball' or 'free'", Difference::kMotion);
  efforts[joint.name] += effortOf(styled, compiler);
}

}  // namespace

void readActuators(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                   const Compiler& compiler, BodyTree& tree) {
  std::unordered_map<std::string, double> efforts;
  for (const Tag& section : sections) {
    for (const Tag& tag : files.children(section.of("<actuator>"), knownOf("actuator"))) {
      if (std::ranges::count(knownOf("actuator").children, tag.name()) == 0) continue;
      tag.expect(knownOf("motor"));
      const Styled styled(tag, defaults.named(tag, "class", defaults.main()), Kind::kActuator);
      tree.forEachReplica(tag, [&] { addEffort(styled, compiler, tree, efforts); });
    }
  }
  for (const auto& [name, effort] : efforts) {
    JointSpec& joint = tree.joints[tree.jointOfName.at(name)].spec;
    joint.maxEffort = std::min(joint.maxEffort, effort);
  }
}

void readEqualities(const std::vector<Tag>& sections, Files& files, const Defaults& defaults,
                    const Compiler& compiler, BodyTree& tree) {
  std::map<std::string, Follower> followers;
  std::vector<Tag> pins;
  const auto couple = [&](const Tag& tag) {
    const bool isJoint = tag.name() == "joint";
    const Styled styled(tag, defaults.named(tag, "class", defaults.main()), Kind::kEquality);
    const std::optional<Follower> follower =
        isJoint ? followerOf(styled, tree) : followerOnTendon(styled, tree);
    if (follower && !followers.emplace(follower->joint, *follower).second)
      tag.warn(tag.where(isJoint ? "joint1" : "tendon1"),
               fmt::format("'{}' already follows another joint; this is ignored", follower->joint),
               Difference::kMotion);
  };
  for (const Tag& section : sections) {
    for (const Tag& tag : files.children(section.of("<equality>"), knownOf("equality"))) {
      if (tag.name() == "connect" || tag.name() == "weld") pins.push_back(tag);
      if (tag.name() != "joint" && tag.name() != "tendon") continue;
      tag.expect(knownOf(tag.name() == "joint" ? "equality/joint" : "equality/tendon"));
      tree.forEachReplica(tag, [&] { couple(tag); });
    }
  }
  for (const auto& [name, unresolved] : followers) {
    Follower follower = unresolved;
    if (!resolve(name, follower, followers)) {
      follower.tag.warn(follower.tag.where(), "joints that follow each other in a loop; this is ignored",
                        Difference::kMotion);
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
