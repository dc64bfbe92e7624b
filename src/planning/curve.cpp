#include "planning/curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rex {
namespace {

// The pose after driving the signed distance `way` from `from`.
Eigen::Vector3d drive(const Eigen::Vector3d& from, Steering steering, double way, double radius) {
  const double heading = from[2];
  if (steering == Steering::kStraight)
    return from + way * Eigen::Vector3d(std::cos(heading), std::sin(heading), 0);
  const double side = steering == Steering::kLeft ? radius : -radius;
  const double next = heading + way / side;
  return {from[0] + side * (std::sin(next) - std::sin(heading)),
          from[1] - side * (std::cos(next) - std::cos(heading)), next};
}

}  // namespace

Curve::Curve(const Eigen::Vector3d& start, double radius, std::span<const CurveSegment> segments)
    : start_(start), radius_(radius), count_(static_cast<int>(segments.size())) {
  assert(segments.size() <= kMostSegments);
  std::copy(segments.begin(), segments.end(), segments_.begin());
}

double Curve::length() const {
  double length = 0;
  for (const CurveSegment& segment : segments()) length += std::abs(segment.length);
  return length;
}

Eigen::Vector3d Curve::pose(double way) const {
  Eigen::Vector3d at = start_;
  for (const CurveSegment& segment : segments()) {
    const double part = std::min(way, std::abs(segment.length));
    at = drive(at, segment.steering, std::copysign(part, segment.length), radius_);
    way -= part;
  }
  return at;
}

std::string Curve::word() const {
  std::string word;
  for (const CurveSegment& segment : segments()) word += "LSR"[static_cast<int>(segment.steering)];
  return word;
}

}  // namespace rex
