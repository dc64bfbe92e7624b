#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include "scene/urdf_parts_internal.h"

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

}  // namespace rex::urdf
