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

}  // namespace rex
