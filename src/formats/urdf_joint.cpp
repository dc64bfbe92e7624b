#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include <fmt/format.h>

#include "formats/urdf_parts_internal.h"
#include "geometry/rotation.h"

namespace rex::urdf {
namespace {

struct Range {
  double lower = -kUnlimited, upper = kUnlimited;
  double width() const { return upper - lower; }
};

Range ownRange(const JointSpec& joint) {
  if (joint.lower.size() == 0) return {};
  return {joint.lower[0], joint.upper[0]};
}

// Where the followed joint may be such that the follower keeps its own limits, as in compile().
Range leaderRange(const JointSpec& follower) {
  const Range own = ownRange(follower);
  const double a = (own.lower - follower.mimicOffset) / follower.mimicRatio;
  const double b = (own.upper - follower.mimicOffset) / follower.mimicRatio;
  return {std::min(a, b), std::max(a, b)};
}

// An overlap of less than a millionth of the narrower range counts as a point.
double tiniestWidth(const Range& a, const Range& b) {
  const double width = std::min(a.width(), b.width());
  return std::isfinite(width) ? 1e-6 * width : 0;
}

std::string describe(const std::string& joint, const Range& range) {
  if (range.lower > range.upper)
    return fmt::format("joint '{}' has no position left: {:.6g} > {:.6g}", joint, range.lower, range.upper);
  return fmt::format("joint '{}' may only be at {:.6g}", joint, range.lower + 0.0);  // no -0
}

}  // namespace

void keepTargetsMovable(std::vector<ReadJoint>& joints, Reading& reading) {
  std::unordered_map<std::string, Range> ranges;
  for (const ReadJoint& joint : joints) ranges[joint.spec.name] = ownRange(joint.spec);
  for (ReadJoint& read : joints) {
    JointSpec& joint = read.spec;
    if (joint.mimic.empty() || joint.lower.size() == 0 || joint.mimicRatio == 0) continue;
    Range& target = ranges.at(joint.mimic);
    const Range wanted = leaderRange(joint);
    const Range both{std::max(target.lower, wanted.lower), std::min(target.upper, wanted.upper)};
    const bool wasPoint = target.width() == 0 && both.width() == 0;
    if (wasPoint || both.width() > tiniestWidth(target, wanted)) {
      target = both;
      continue;
    }
    reading.forgive({.what = fmt::format("joint '{}': limits", joint.name),
                     .where = joint.where,
                     .found = describe(joint.mimic, both),
                     .wanted = "limits that both joints can satisfy"},
                    fmt::format("those of '{}' are left out", joint.name));
    joint.lower.resize(0);
    joint.upper.resize(0);
  }
}

namespace {

const std::vector<std::string> kUrdfTypes = {"revolute", "continuous", "prismatic",
                                             "fixed",    "floating",   "planar"};
constexpr std::array<JointType, 6> kTypesOfUrdf = {JointType::kHinge,  JointType::kHinge,
                                                   JointType::kSlider, JointType::kRigid,
                                                   JointType::kFree,   JointType::kPlanarXYPhi};

Eigen::Vector3d readAxis(const Tag& joint) {
  const std::optional<Tag> tag = joint.child("axis");
  if (!tag) return Eigen::Vector3d::UnitX();
  static const Known kKnown = {{"xyz"}, {}};
  tag->expect(kKnown);
  const Eigen::Vector3d axis = tag->numbers("xyz", 3);
  constexpr double kTiny = 1e-100;
  if (!(axis.stableNorm() > kTiny && axis.stableNorm() < 1 / kTiny))
    tag->failAt("xyz", xml::quoted(tag->text("xyz")), "a direction");
  return axis;
}

// The plane of a planar joint is perpendicular to its axis; ours is the x-y plane.
void turnPlane(JointSpec& joint) {
  const Eigen::Matrix3d R = rotationBetween(Eigen::Vector3d::UnitZ(), joint.axis);
  joint.X_PF.R *= R;
  joint.X_MC.R = R.transpose();
  joint.axis = Eigen::Vector3d::UnitX();
}

void readRange(const Tag& limit, JointSpec& joint) {
  const double lower = limit.number("lower", 0), upper = limit.number("upper", 0);
  if (lower > upper) {
    limit.forgiveAt("lower", fmt::format("{} > {}", lower, upper),
                    "a lower limit that is not above the upper", "the joint has no range");
    return;
  }
  if (!limit.has("lower") && !limit.has("upper")) {
    if (!joint.mimic.empty()) return;  // it has the range of the other
    limit.warn(limit.where(), "without 'lower' and 'upper' the joint stays at 0");
  }
  // Larger numbers mean that there is no limit.
  constexpr double kTwoTurns = 4 * std::numbers::pi, kLargestAngle = 1000;
  const double largest = std::max(std::abs(lower), std::abs(upper));
  if (joint.type == JointType::kHinge && largest > kTwoTurns && largest <= kLargestAngle)
    limit.warn(limit.where(),
               fmt::format("the range is {} to {}: degrees? angles are radians", lower, upper));
  joint.lower = Eigen::VectorXd::Constant(1, lower);
  joint.upper = Eigen::VectorXd::Constant(1, upper);
}

void readLimit(const Tag& tag, bool hasRange, JointSpec& joint) {
  static const Known kKnown = {{"lower", "upper", "velocity", "effort"}, {}};
  const std::string wanted = fmt::format("<limit lower=.. upper=.. effort=.. velocity=..>{}",
                                         joint.type == JointType::kHinge ? " or type 'continuous'" : "");
  const std::optional<Tag> limit = hasRange ? tag.neededChild("limit", wanted) : tag.child("limit");
  if (!limit) return;
  limit->expect(kKnown);
  if (hasRange) {
    readRange(*limit, joint);
  } else if (limit->has("lower") || limit->has("upper")) {
    limit->ignore(fmt::format("the range in <limit> of joints of type '{}'", tag.text("type")));
  }
  if (joint.type == JointType::kRigid) return;
  for (const char* needed : {"velocity", "effort"}) {
    if (!limit->has(needed))
      limit->warn(limit->where(),
                  fmt::format("attribute '{}' is missing, so there is no such limit", needed));
  }
  joint.maxVelocity = limit->notNegative("velocity", joint.maxVelocity);
  joint.maxEffort = limit->notNegative("effort", joint.maxEffort);
}

void readDynamics(const Tag& joint, JointSpec& spec) {
  const std::optional<Tag> tag = joint.child("dynamics");
  if (!tag) return;
  static const Known kKnown = {{"damping", "friction"}, {}};
  tag->expect(kKnown);
  spec.damping = tag->notNegative("damping", 0);
  spec.friction = tag->notNegative("friction", 0);
}

void readMimic(const Tag& joint, ReadJoint& read) {
  const std::optional<Tag> tag = joint.child("mimic");
  if (!tag) return;
  static const Known kKnown = {{"joint", "multiplier", "offset"}, {}};
  tag->expect(kKnown);
  const std::string wanted = "revolute, continuous or prismatic";
  if (read.spec.type == JointType::kRigid) {
    joint.forgive(tag->where(), "<mimic>", "a joint of type 'fixed'", wanted, "it is ignored");
    return;
  }
  if (positionCount(read.spec.type) != 1) {
    joint.fail(tag->where(), "<mimic>", fmt::format("a joint of type '{}'", joint.text("type")), wanted);
  }
  read.spec.mimic = tag->nameIn("joint");
  read.mimicAt = tag->where("joint");
  read.spec.mimicRatio = tag->number("multiplier", 1);
  read.spec.mimicOffset = tag->number("offset", 0);
}

std::string readEnd(const Tag& joint, const char* name, SourceLocation& where) {
  static const Known kKnown = {{"link"}, {}};
  const Tag tag = joint.neededChild(name);
  tag.expect(kKnown);
  where = tag.where("link");
  return tag.nameIn("link");
}

}  // namespace

ReadJoint readJoint(const Tag& tag) {
  static const Known kKnown = {{"name", "type"},
                               {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"},
                               {"safety_controller", "calibration", "gazebo"}};
  ReadJoint read;
  JointSpec& spec = read.spec;
  spec.name = tag.nameIn("name");
  const Tag joint = tag.of(fmt::format("joint '{}'", spec.name));
  joint.expect(kKnown);
  spec.where = joint.where();
  const std::string& type = joint.text("type");
  const auto known = std::find(kUrdfTypes.begin(), kUrdfTypes.end(), type);
  if (known == kUrdfTypes.end()) {
    joint.fail(joint.where("type"), "unknown type", xml::quoted(type),
               "revolute, continuous, prismatic, fixed, floating or planar", nearestNames(type, kUrdfTypes));
  }
  spec.type = kTypesOfUrdf[static_cast<std::size_t>(known - kUrdfTypes.begin())];
  spec.parent = readEnd(joint, "parent", read.parentAt);
  spec.child = readEnd(joint, "child", read.childAt);
  spec.X_PF = joint.origin();
  // Others have none; exporters write zeros there.
  if (type != "fixed" && type != "floating") spec.axis = readAxis(joint);
  if (spec.type == JointType::kPlanarXYPhi) turnPlane(spec);
  readMimic(joint, read);
  readLimit(joint, type == "revolute" || type == "prismatic", spec);
  readDynamics(joint, spec);
  return read;
}

}  // namespace rex::urdf
