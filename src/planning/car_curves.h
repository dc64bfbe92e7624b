#pragma once

#include <array>
#include <span>
#include <string>

#include <Eigen/Core>

namespace rex {

/// How a car steers while it drives a piece of a curve.
enum class Steering { kLeft, kStraight, kRight };

struct CurveSegment {
  Steering steering = Steering::kStraight;
  double length = 0;  ///< metres; negative: driven backward
};

/// A path of straight segments and arcs of one radius that starts at a pose (x, y, heading; metres and
/// radians, left turns positive).
class Curve {
 public:
  static constexpr int kMostSegments = 5;

  Curve() = default;
  Curve(const Eigen::Vector3d& start, double radius, std::span<const CurveSegment> segments);

  std::span<const CurveSegment> segments() const {
    return {segments_.data(), static_cast<std::size_t>(count_)};
  }
  const Eigen::Vector3d& start() const { return start_; }
  double radius() const { return radius_; }
  /// Metres driven, forward and backward.
  [[nodiscard]] double length() const;
  /// The pose after `way` metres, between 0 and length(); its heading is not wrapped.
  [[nodiscard]] Eigen::Vector3d pose(double way) const;
  /// "LSR", "RLR", ..., a letter for each segment.
  [[nodiscard]] std::string word() const;

 private:
  Eigen::Vector3d start_{0, 0, 0};
  double radius_ = 1;
  std::array<CurveSegment, kMostSegments> segments_{};
  int count_ = 0;
};

// Poses are (x, y, heading), metres and radians. All functions throw Error for a pose that is not finite and
// a radius that is not positive and finite.

/// The shortest path between two poses for a car that only drives forward, with turns no tighter than
/// `radius`: the best of the words LSL, LSR, RSL, RSR, LRL, RLR. Slide 4:60; Dubins 1957; Shkel and
/// Lumelsky 2001.
[[nodiscard]] Curve dubinsCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// Only its length, metres; faster than computing the curve.
[[nodiscard]] double dubinsLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

/// The shortest path between two poses for a car that may also drive backward, with turns no tighter than
/// `radius`, among all words of Reeds and Shepp. Slide 4:61; Reeds and Shepp, Optimal paths for a car that
/// goes both forwards and backwards, 1990. Throws like dubinsCurve.
[[nodiscard]] Curve reedsSheppCurve(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
/// Only its length, metres; faster than computing the curve. It is a metric: symmetric, and satisfies the
/// triangle inequality.
[[nodiscard]] double reedsSheppLength(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

}  // namespace rex
